// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <linux/videodev2.h>

#include <cstdint>

#include "disflow/hal/depth_sensor.h"
#include "disflow/types.h"

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
  constexpr std::int64_t kNsPerUs = 1'000;
  return std::int64_t{buffer.timestamp.tv_sec} * kSecond_ns +
         std::int64_t{buffer.timestamp.tv_usec} * kNsPerUs;
}

/// Follows a driver's sequence numbers, which may wrap.
class SequenceCheck {
 public:
  struct Verdict {
    std::uint32_t missing = 0;  ///< Frames between the last one and this one.
    /// Comes after a newer one (uvcvideo completes buffers in parallel); it was counted as missing.
    bool late = false;
  };

  [[nodiscard]] Verdict Judge(std::uint32_t sequence) noexcept {
    const std::uint32_t ahead = sequence - last_;
    const std::uint32_t behind = last_ - sequence;
    if (started_ && behind != 0 && behind <= kMostBehind) return {0, true};
    const bool is_gap = started_ && ahead != 0 && ahead <= kMostMissing;
    last_ = sequence;
    started_ = true;
    return {is_gap ? ahead - 1 : 0, false};
  }
  void Restart() noexcept { started_ = false; }

 private:
  // More than that is not a gap but a counter that jumped.
  static constexpr std::uint32_t kMostMissing = 1U << 20U;
  // No more can be under way than there are buffers.
  static constexpr std::uint32_t kMostBehind = 8;

  bool started_ = false;
  std::uint32_t last_ = 0;
};

}  // namespace disflow::posix
