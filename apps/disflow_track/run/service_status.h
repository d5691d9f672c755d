// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "disflow/posix/service_notifier.h"
#include "program/frame_result.h"

namespace disflow::apps {

/// Keeps systemd informed: ready, alive, what is going on. See ServiceNotifier.
class ServiceStatus {
 public:
  void Ready() noexcept { notifier_.Ready(); }
  void Stopping() noexcept { notifier_.Stopping(); }
  /// Once per turn of the tracking loop, also if no frame came.
  /// @param results One per object.
  /// @param source_is_alive false: the capture thread hangs, and the watchdog shall find out.
  void Turn(std::span<const FrameResult> results, bool source_is_alive,
            std::int64_t now_ns) noexcept;

 private:
  void Report(std::span<const FrameResult> results, std::int64_t now_ns) noexcept;

  posix::ServiceNotifier notifier_;
  std::int64_t reported_ns_ = 0;
  std::int64_t reported_frame_ = 0;
};

}  // namespace disflow::apps
