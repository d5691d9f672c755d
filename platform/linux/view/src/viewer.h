// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <libwebsockets.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "client_frames.h"
#include "disflow/posix/view/web_server.h"

namespace disflow::posix {

/// A browser that has the page open: what it is sent, and what it says. libwebsockets writes to its
/// socket and does not read from it: that is done here, through a copy of the descriptor, since
/// frames have to be refused that libwebsockets takes (ClientFrames).
class Viewer {
 public:
  static constexpr std::size_t kChunkBytes = 16384;

  /// @param socket Of the WebSocket; it owns the viewer.
  Viewer(lws* socket, const MessageBoard& board, const WebServer::CommandHandler& on_command)
      : socket_(socket), board_(board), on_command_(on_command) {}

  /// Sends what is next. The first time, it also begins to listen.
  /// @param buffer Has room for LWS_PRE and kChunkBytes.
  /// @return What libwebsockets' callback has to.
  [[nodiscard]] int OnWriteable(std::span<std::uint8_t> buffer);
  /// Reads what has come. @return As OnWriteable(), for the copy of the descriptor.
  [[nodiscard]] int OnInput(std::span<std::uint8_t> buffer);

 private:
  enum class Listening : std::uint8_t { kNotYet, kYes, kNoMore };

  [[nodiscard]] bool Listen();
  [[nodiscard]] bool Answer(ClientFrame frame);
  [[nodiscard]] bool TakeCommand(std::span<const std::uint8_t> bytes);
  [[nodiscard]] int HangUp();
  [[nodiscard]] int SendPong(std::span<std::uint8_t> buffer);
  [[nodiscard]] int SendNext(std::span<std::uint8_t> buffer);

  lws* socket_;
  const MessageBoard& board_;
  const WebServer::CommandHandler& on_command_;
  Listening listening_ = Listening::kNotYet;
  ClientFrames frames_;
  std::optional<std::vector<std::uint8_t>> pong_;  ///< To be sent.
  /// What it is hung up with, once there is no more to hear from it.
  lws_close_status close_status_ = LWS_CLOSE_STATUS_NOSTATUS;
  MessageBoard::Cursor cursor_;
  MessageBoard::Message message_;  ///< Being sent.
  std::size_t sent_ = 0;
  lws_usec_t second_begin_us_ = 0;
  int commands_ = 0;  ///< Since then.
};

}  // namespace disflow::posix
