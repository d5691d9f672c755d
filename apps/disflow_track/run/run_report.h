// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "program/frame_result.h"
#include "run/duration_histogram.h"

namespace disflow::apps {

/// "time per frame: median 3.10 ms, 99 % below 4.20 ms"
[[nodiscard]] std::string FormatTimes(const DurationHistogram& times);

/// What a run amounts to for one object, for the lines at its end.
class RunReport {
 public:
  void Add(const FrameResult& result) noexcept;

  [[nodiscard]] std::int64_t frames() const noexcept { return frames_; }
  /// Frames whose pose was measured.
  [[nodiscard]] std::int64_t registered() const noexcept { return registered_; }
  /// Why most of the other frames have none; kOk if all have one.
  [[nodiscard]] Status most_frequent_fault() const noexcept;

  /// @return Several lines, indented but for the first.
  [[nodiscard]] std::string Format(double seconds) const;

 private:
  std::int64_t frames_ = 0;
  std::int64_t registered_ = 0;
  std::array<std::int64_t, 256> by_status_{};
  DurationHistogram total_;
  Counters totals_;
  float model_coarseness_ = 1.0F;
  hal::SensorCounters sensor_;
  TrackingState state_ = TrackingState::kInitialising;
  std::uint8_t quality_ = 0;
  std::uint8_t restarts_ = 0;
};

}  // namespace disflow::apps
