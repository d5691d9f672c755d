// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "disflow/hal/fault.h"
#include "disflow/posix/view/message_board.h"
#include "disflow/posix/view/web_address.h"

namespace disflow::posix {

/// A file of the page, as it stands in the program.
struct WebAsset {
  std::string_view path;          ///< From the slash on.
  std::string_view content_type;  ///< With its charset.
  std::span<const std::uint8_t> gzip;
};

struct WebServerOptions {
  WebAddress address;
  std::string token;          ///< Asked of everybody; empty: of nobody.
  int max_connections = 32;   ///< More are closed at once.
  int max_viewers = 8;        ///< Connections that get messages.
  int request_timeout_s = 5;  ///< For a whole request, and for one that follows on a connection.
  /// For a connection that is no viewer's, whatever it does.
  int connection_timeout_s = 60;
  int ping_after_s = 5;      ///< A viewer that has been silent for this long is pinged,
  int hang_up_after_s = 15;  ///< and for this long is hung up on.
  /// What is answered to GET /metrics, in Prometheus' text format; empty: there is no such page.
  /// Called by the server's thread.
  std::function<std::string()> metrics;
};

/// Serves a page that is held in memory, and gives every browser that has it open the messages of a
/// board, over HTTP and WebSocket, in one thread of its own that starts with no signals, without
/// real-time priority. No file can be reached through it. Requests that are too long, too slow or
/// malformed end their connection and nothing else.
class WebServer {
 public:
  /// Name of the WebSocket protocol; it is offered at kSocketPath.
  static constexpr const char* kProtocol = "disflow.v1";
  static constexpr const char* kSocketPath = "/live";
  /// A message from a browser has one of these numbers of bytes.
  static constexpr std::size_t kCommandBytes = 4;
  static constexpr std::size_t kLongCommandBytes = 14;

  /// Called by the server's thread.
  using CommandHandler = std::function<void(std::span<const std::uint8_t>)>;

  /// @param assets, board Outlive the server.
  WebServer(WebServerOptions options, std::span<const WebAsset> assets, const MessageBoard& board,
            CommandHandler on_command);
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;
  ~WebServer();

  /// Listens, once.
  /// @return kBusy, kPermissionDenied, kNotFound (address), kIoError.
  [[nodiscard]] hal::Fault Start();

  /// There are new messages on the board. By any thread; does not wait.
  void Notify() noexcept;

  /// @return What is listened on, after Start().
  [[nodiscard]] int port() const noexcept;
  [[nodiscard]] int viewers() const noexcept;

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace disflow::posix
