// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "named_datagrams.h"

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
  explicit ServiceManager(const std::string& name = AbstractName()) : socket_(name) {
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
  }
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;
  ~ServiceManager() {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
  }

  /// Wants to hear from services at least so often.
  void StartWatchdog(int period_us) const {
    ::setenv("WATCHDOG_USEC", std::to_string(period_us).c_str(), 1);
  }

  /// What has come since the last call.
  [[nodiscard]] std::vector<std::string> Received() const { return socket_.Received(); }

 private:
  NamedDatagrams socket_;
};

}  // namespace disflow::test
