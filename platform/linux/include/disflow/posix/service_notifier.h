// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

#include "disflow/posix/unix_datagrams.h"

namespace disflow::posix {

/// Tells systemd how the service is: sd_notify(3)'s datagrams, sent without its library. Does
/// nothing where no service manager asked for it. Never blocks, never allocates after construction.
class ServiceNotifier {
 public:
  /// Reads NOTIFY_SOCKET and WATCHDOG_USEC from the environment.
  ServiceNotifier() noexcept;

  /// @return true if somebody listens.
  [[nodiscard]] bool active() const noexcept { return manager_.is_open(); }
  /// The start is complete.
  void Ready() noexcept { Send("READY=1"); }
  /// The end has begun.
  void Stopping() noexcept { Send("STOPPING=1"); }
  /// One line for `systemctl status`; cut at 200 bytes.
  void Status(std::string_view text) noexcept;
  /// "Still alive": call it often; a datagram goes out four times per watchdog period.
  void Beat(std::int64_t now_ns) noexcept;

  [[nodiscard]] std::int64_t watchdog_ns() const noexcept { return watchdog_ns_; }

 private:
  void Send(std::string_view message) noexcept;

  UnixDatagrams manager_;
  std::int64_t watchdog_ns_ = 0;  ///< 0: nobody watches.
  std::int64_t beat_ns_ = 0;
  bool beaten_ = false;
};

}  // namespace disflow::posix
