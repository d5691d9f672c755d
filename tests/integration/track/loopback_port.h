// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>

#include "disflow/posix/file_descriptor.h"

namespace disflow::test {

/// A UDP port of the loopback.
class LoopbackPort {
 public:
  LoopbackPort() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address = Address(0);
    auto* const generic = reinterpret_cast<sockaddr*>(&address);
    if (::bind(socket_.get(), generic, sizeof(address)) != 0) throw std::runtime_error("bind");
    socklen_t size = sizeof(address);
    (void)::getsockname(socket_.get(), generic, &size);
    number_ = ntohs(address.sin_port);
  }
  [[nodiscard]] std::uint16_t number() const { return number_; }
  void SendTo(std::uint16_t port, std::span<const std::byte> bytes) const {
    const sockaddr_in address = Address(port);
    (void)::sendto(socket_.get(), bytes.data(), bytes.size(), 0,
                   reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  }
  /// @return Bytes of a datagram, 0 if none came within the time.
  std::size_t Receive(std::span<std::byte> buffer, int timeout_ms) const {
    pollfd waiting{.fd = socket_.get(), .events = POLLIN, .revents = 0};
    if (::poll(&waiting, 1, timeout_ms) <= 0) return 0;
    const ssize_t size = ::recv(socket_.get(), buffer.data(), buffer.size(), 0);
    return size > 0 ? static_cast<std::size_t>(size) : 0;
  }

 private:
  static sockaddr_in Address(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }
  posix::FileDescriptor socket_;
  std::uint16_t number_ = 0;
};

}  // namespace disflow::test
