// SPDX-License-Identifier: BSD-3-Clause
#include "viewer.h"

#include <fcntl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "disflow/posix/file_descriptor.h"

namespace disflow::posix {
namespace {

constexpr int kCommandsPerSecond = 20;
constexpr lws_usec_t kSecond_us = 1'000'000;

}  // namespace

int Viewer::OnWriteable(std::span<std::uint8_t> buffer) {
  if (listening_ == Listening::kNotYet && !Listen()) return -1;
  if (listening_ == Listening::kNoMore) return HangUp();
  if (pong_) return SendPong(buffer);
  return SendNext(buffer);
}

/// Not before libwebsockets has looked at what may have come in one piece with the request.
bool Viewer::Listen() {
  lws_sock_file_fd_type copy{};
  copy.filefd = ::fcntl(lws_get_socket_fd(socket_), F_DUPFD_CLOEXEC, 0);
  if (copy.filefd < 0) return false;
  // Closed by libwebsockets, with the WebSocket at the latest.
  if (lws_adopt_descriptor_vhost(lws_get_vhost(socket_), LWS_ADOPT_RAW_FILE_DESC, copy, nullptr,
                                 socket_) == nullptr) {
    return false;
  }
  listening_ = Listening::kYes;
  return lws_rx_flow_control(socket_, 0) >= 0;
}

int Viewer::OnInput(std::span<std::uint8_t> buffer) {
  const ssize_t count = RetryOnSignal([&] {
    return ::recv(lws_get_socket_fd(socket_), buffer.data(), buffer.size(), MSG_DONTWAIT);
  });
  if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return 0;
  bool goes_on = count > 0;
  std::span<const std::uint8_t> bytes =
      buffer.first(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  while (goes_on) {
    const std::optional<ClientFrame> frame = frames_.Take(bytes);
    if (!frame) return 0;
    goes_on = Answer(*frame);
  }
  // libwebsockets reads the rest, if any, while it waits for the answer to its close frame.
  listening_ = Listening::kNoMore;
  (void)lws_callback_on_writable(socket_);
  return -1;
}

/// @return Whether there is more to hear.
bool Viewer::Answer(ClientFrame frame) {
  switch (frame) {
    case ClientFrame::kMessage:
      return TakeCommand(frames_.payload());
    case ClientFrame::kPing:
      // Of several the last is answered, which section 5.5.3 allows.
      pong_.emplace(frames_.payload().begin(), frames_.payload().end());
      return lws_callback_on_writable(socket_) >= 0;
    case ClientFrame::kPong:
      lws_validity_confirmed(socket_);
      return true;
    case ClientFrame::kClose:
      close_status_ = LWS_CLOSE_STATUS_NORMAL;
      return false;
    case ClientFrame::kNotAllowed:
      close_status_ = LWS_CLOSE_STATUS_POLICY_VIOLATION;
      return false;
    case ClientFrame::kMalformed:
      close_status_ = LWS_CLOSE_STATUS_PROTOCOL_ERR;
      return false;
  }
  return false;
}

/// @return False if it may not be given.
bool Viewer::TakeCommand(std::span<const std::uint8_t> bytes) {
  const lws_usec_t now_us = lws_now_usecs();
  if (now_us - second_begin_us_ > kSecond_us) {
    second_begin_us_ = now_us;
    commands_ = 0;
  }
  const bool is_command =
      bytes.size() == WebServer::kCommandBytes || bytes.size() == WebServer::kLongCommandBytes;
  if (!is_command || ++commands_ > kCommandsPerSecond) {
    close_status_ = LWS_CLOSE_STATUS_POLICY_VIOLATION;
    return false;
  }
  on_command_(bytes);
  return true;
}

int Viewer::HangUp() {
  if (close_status_ == LWS_CLOSE_STATUS_NORMAL) {
    // The answer to a close frame. libwebsockets would wait for another after its own; what it has
    // to send is sent when this is called.
    constexpr std::array<std::uint8_t, 4> kAnswer{0x88, 2, LWS_CLOSE_STATUS_NORMAL >> 8U,
                                                  LWS_CLOSE_STATUS_NORMAL & 0xFFU};
    (void)(::send(lws_get_socket_fd(socket_), kAnswer.data(), kAnswer.size(),
                  MSG_DONTWAIT | MSG_NOSIGNAL) > 0);
  } else if (close_status_ != LWS_CLOSE_STATUS_NOSTATUS) {
    lws_close_reason(socket_, close_status_, nullptr, 0);
  }
  return -1;
}

int Viewer::SendPong(std::span<std::uint8_t> buffer) {
  std::copy(pong_->begin(), pong_->end(), buffer.begin() + LWS_PRE);
  const std::size_t size = pong_->size();
  pong_.reset();
  if (lws_write(socket_, &buffer[LWS_PRE], size, LWS_WRITE_PONG) < static_cast<int>(size))
    return -1;
  return lws_callback_on_writable(socket_) < 0 ? -1 : 0;
}

int Viewer::SendNext(std::span<std::uint8_t> buffer) {
  if (message_ == nullptr) {
    message_ = board_.Next(cursor_);
    sent_ = 0;
    if (message_ == nullptr) return 0;
  }
  const auto left = std::span(*message_).subspan(sent_);
  const auto chunk = left.first(std::min(left.size(), kChunkBytes));
  std::memcpy(&buffer[LWS_PRE], chunk.data(), chunk.size());
  const bool is_last = chunk.size() == left.size();
  const int flags = lws_write_ws_flags(LWS_WRITE_BINARY, sent_ == 0, is_last);
  if (lws_write(socket_, &buffer[LWS_PRE], chunk.size(), static_cast<lws_write_protocol>(flags)) <
      static_cast<int>(chunk.size())) {
    return -1;
  }
  sent_ += chunk.size();
  if (is_last) message_.reset();
  return lws_callback_on_writable(socket_) < 0 ? -1 : 0;
}

}  // namespace disflow::posix
