// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <libwebsockets.h>

#include <array>
#include <atomic>
#include <memory>
#include <span>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "disflow/posix/view/web_server.h"
#include "request.h"

namespace disflow::posix {

class Viewer;

/// The server's work on libwebsockets, without its thread.
class WebService {
 public:
  WebService(WebServerOptions options, std::span<const WebAsset> assets, const MessageBoard& board,
             WebServer::CommandHandler on_command);
  WebService(const WebService&) = delete;
  WebService& operator=(const WebService&) = delete;
  ~WebService();

  [[nodiscard]] hal::Fault Open();
  /// Waits for traffic or Wake(), and deals with it.
  void Turn();
  /// By any thread.
  void Wake() noexcept;

  [[nodiscard]] int port() const noexcept { return port_; }
  [[nodiscard]] int viewers() const noexcept { return viewers_; }

 private:
  /// Of an HTTP connection; libwebsockets zeroes it.
  struct Download {
    const WebAsset* asset;
    std::string* text;  ///< In place of an asset; owned.
    std::size_t sent;
  };
  /// Of a WebSocket connection; libwebsockets zeroes it.
  struct Session {
    Viewer* viewer;
  };

  static int OnEvent(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t size);
  int Handle(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t size);

  [[nodiscard]] Request Read(lws* wsi) const;
  [[nodiscard]] int AnswerRequest(lws* wsi, Download& download, std::string_view path);
  [[nodiscard]] int BeginDownload(lws* wsi, bool header_is_written);
  [[nodiscard]] int ContinueDownload(lws* wsi, Download& download);
  [[nodiscard]] int AnswerUpgrade(lws* wsi);
  [[nodiscard]] int RedirectWithCookie(lws* wsi);

  WebServerOptions options_;
  std::span<const WebAsset> assets_;
  const MessageBoard& board_;
  WebServer::CommandHandler on_command_;
  std::string cookie_name_;
  std::array<lws_protocols, 3> protocols_{};
  lws_retry_bo_t retry_{};
  lws_context* context_ = nullptr;
  int port_ = 0;
  std::atomic<int> viewers_ = 0;
  int idle_turns_ = 0;  ///< In which nothing happened, one after the other.
  std::unordered_set<lws*> connections_;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace disflow::posix
