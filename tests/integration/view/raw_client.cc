// SPDX-License-Identifier: BSD-3-Clause
#include "raw_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>

namespace disflow {
namespace {

constexpr int kPatience_ms = 60'000;

/// A connection whose making a signal has interrupted goes on by itself.
bool IsMade(int socket) {
  pollfd ready = {socket, POLLOUT, 0};
  if (posix::RetryOnSignal([&] { return poll(&ready, 1, kPatience_ms); }) <= 0) return false;
  int error = 0;
  socklen_t size = sizeof(error);
  return getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0;
}

}  // namespace

RawClient::RawClient(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const auto* const generic = reinterpret_cast<const sockaddr*>(&address);
  if (connect(socket_.get(), generic, sizeof(address)) == 0) return;
  closed_ = errno != EINTR || !IsMade(socket_.get());
}

bool RawClient::Send(std::string_view bytes) {
  while (!bytes.empty() && !closed_) {
    const ssize_t sent = posix::RetryOnSignal(
        [&] { return send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL); });
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return !closed_;
}

void RawClient::EndSending() { (void)shutdown(socket_.get(), SHUT_WR); }

bool RawClient::Receive(std::string& text) {
  pollfd ready = {socket_.get(), POLLIN, 0};
  if (closed_) return false;
  // A fuzzer's alarm clock is no end of the connection.
  if (posix::RetryOnSignal([&] { return poll(&ready, 1, kPatience_ms); }) <= 0) return false;
  std::array<char, 4096> bytes{};
  const ssize_t size =
      posix::RetryOnSignal([&] { return recv(socket_.get(), bytes.data(), bytes.size(), 0); });
  closed_ = size <= 0;
  if (!closed_) text.append(bytes.data(), static_cast<std::size_t>(size));
  return !closed_;
}

std::string RawClient::ReadUntil(std::string_view end) {
  std::string text;
  // Not from the beginning each time: of many megabytes that takes longer than a viewer may be
  // silent.
  std::size_t from = 0;
  while (text.find(end, from) == std::string::npos) {
    from = text.size() - std::min(text.size(), end.size());
    if (!Receive(text)) break;
  }
  return text;
}

bool RawClient::IsClosedByServer() {
  std::string rest;
  while (Receive(rest)) {
  }
  return closed_;
}

bool RawClient::IsHungUpOn() {
  constexpr std::string_view kCloseFrame = "\x88";
  return ReadUntil(kCloseFrame).find(kCloseFrame) != std::string::npos || closed_;
}

std::string Ask(int port, std::string_view request) {
  RawClient client(port);
  client.Send(request);
  std::string answer = client.ReadUntil("\r\n\r\n");
  const std::size_t length_at = answer.find("content-length: ");
  if (length_at == std::string::npos) return answer;
  std::size_t length = 0;
  const char* const digits = answer.data() + length_at + 16;
  (void)std::from_chars(digits, answer.data() + answer.size(), length);
  const std::size_t whole = answer.find("\r\n\r\n") + 4 + length;
  while (answer.size() < whole) {
    if (!client.Receive(answer)) break;
  }
  return answer;
}

std::string Get(int port, const std::string& path, const std::string& headers) {
  const bool names_host = headers.find("Host:") != std::string::npos;
  return Ask(port, "GET " + path + " HTTP/1.1\r\n" +
                       (names_host ? "" : "Host: localhost:" + std::to_string(port) + "\r\n") +
                       headers + "\r\n");
}

int StatusOf(std::string_view answer) {
  int status = 0;
  if (answer.starts_with("HTTP/1.1 ") || answer.starts_with("HTTP/1.0 ")) {
    (void)std::from_chars(answer.data() + 9, answer.data() + answer.size(), status);
  }
  return status;
}

std::string Upgrade(int port, const std::string& headers, const std::string& path,
                    const std::string& protocol) {
  return "GET " + path + " HTTP/1.1\r\nHost: localhost:" + std::to_string(port) +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: " +
         protocol + "\r\n" + headers + "\r\n";
}

std::string Frame(unsigned char first_byte, std::string_view payload) {
  // The mask of zeros leaves the payload as it is.
  std::string frame = {static_cast<char>(first_byte), static_cast<char>(0x80U | payload.size())};
  frame.append(4, '\0');
  return frame.append(payload);
}

std::string UnmaskedFrame(unsigned char first_byte, std::string_view payload) {
  const std::string frame = {static_cast<char>(first_byte), static_cast<char>(payload.size())};
  return frame + std::string(payload);
}

}  // namespace disflow
