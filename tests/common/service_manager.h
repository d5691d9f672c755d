// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace disflow::test {

/// What systemd is to a service: a datagram socket, its name in the environment, and a watchdog.
/// Programs that are started while it exists report to it.
class ServiceManager {
 public:
  /// In no folder; another one for every process.
  [[nodiscard]] static std::string AbstractName() {
    return "@disflow-test-" + std::to_string(::getpid());
  }

  /// @param name A path, or after '@' an abstract name.
  explicit ServiceManager(const std::string& name = AbstractName())
      : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_un own{};
    own.sun_family = AF_UNIX;
    std::memcpy(own.sun_path, name.data(), name.size());
    if (name[0] == '@') own.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&own), size), 0);
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
  }
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;
  ~ServiceManager() {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
    ::close(socket_);
  }

  /// Wants to hear from services at least so often.
  void StartWatchdog(int period_us) const {
    ::setenv("WATCHDOG_USEC", std::to_string(period_us).c_str(), 1);
  }

  /// What has come since the last call.
  [[nodiscard]] std::vector<std::string> Received() const {
    std::vector<std::string> messages;
    std::array<char, 512> buffer{};
    for (;;) {
      const ssize_t size = ::recv(socket_, buffer.data(), buffer.size(), 0);
      if (size < 0) return messages;
      messages.emplace_back(buffer.data(), static_cast<std::size_t>(size));
    }
  }

 private:
  int socket_;
};

}  // namespace disflow::test
