// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <linux/videodev2.h>

#include <cstdint>

#include "disflow/hal/depth_sensor.h"

namespace disflow::posix {

/// @return true if the driver's stamp is of CLOCK_MONOTONIC.
[[nodiscard]] inline bool IsMonotonic(const v4l2_buffer& buffer) noexcept {
  return (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
}

[[nodiscard]] inline hal::StampPoint StampPointOf(const v4l2_buffer& buffer) noexcept {
  return (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE
             ? hal::StampPoint::kStartOfExposure
             : hal::StampPoint::kEndOfFrame;
}

/// Without overflow for any stamp of the next 292 years.
[[nodiscard]] inline std::int64_t StampNsOf(const v4l2_buffer& buffer) noexcept {
  constexpr std::int64_t kNsPerSecond = 1'000'000'000;
  constexpr std::int64_t kNsPerUs = 1'000;
  return std::int64_t{buffer.timestamp.tv_sec} * kNsPerSecond +
         std::int64_t{buffer.timestamp.tv_usec} * kNsPerUs;
}

/// Counts frames that are missing in a driver's sequence numbers, which may wrap.
class SequenceCheck {
 public:
  /// @return Frames missing between the last one and this one; 0 for the first and for a driver
  /// that starts counting anew.
  [[nodiscard]] std::uint32_t Missing(std::uint32_t sequence) noexcept {
    const std::uint32_t missing = sequence - last_ - 1;
    const bool plausible = started_ && missing < kMostMissing;
    last_ = sequence;
    started_ = true;
    return plausible ? missing : 0;
  }
  void Restart() noexcept { started_ = false; }

 private:
  // More is no gap but a counter that jumped.
  static constexpr std::uint32_t kMostMissing = 1U << 20U;

  bool started_ = false;
  std::uint32_t last_ = 0;
};

}  // namespace disflow::posix
