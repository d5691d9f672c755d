// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "disflow/hal/clock.h"
#include "disflow/hal/depth_sensor.h"
#include "input/stamp_pacer.h"
#include "program/console.h"
#include "settings/options.h"

namespace disflow::apps {

/// Takes frames from a sensor at the wanted pace, until its end, the wanted number of frames or a
/// stop signal. Says which frames could not be read, and waits for a live device that went away.
class FrameSource {
 public:
  enum class Event : std::uint8_t {
    kFrame,       ///< `frame` is filled.
    kUnreadable,  ///< One frame of the input is lost; fault_status() says why.
    kIdle,        ///< Nothing came for a while; ask again.
    kInput,       ///< Something else came in for which the tracking thread waits, see FrameFeed.
    kEnd,
  };

  /// @param sensor Open, outlives this.
  FrameSource(hal::DepthSensor& sensor, hal::Clock& clock, Rate rate, std::int64_t max_frames,
              Console& console) noexcept;

  /// @throws Failure kInputFailed if the sensor failed for good.
  [[nodiscard]] Event Next(DepthFrame& frame);

  [[nodiscard]] Status fault_status() const noexcept { return fault_status_; }
  /// Frames lost so far because their files or packets were damaged.
  [[nodiscard]] std::int64_t unreadable() const noexcept { return unreadable_; }
  /// Age of a frame now; negative if the sensor's stamps are not of this clock.
  [[nodiscard]] std::int64_t AgeNs(StampNs stamp_ns) noexcept;

 private:
  void Pace(StampNs stamp_ns) noexcept;
  void SayUnreadable(const hal::Fault& fault) noexcept;
  void SayRestart(const hal::Fault& fault) noexcept;
  void TryReopen(const hal::Fault& fault) noexcept;

  hal::DepthSensor& sensor_;
  hal::Clock& clock_;
  bool live_;
  bool monotonic_;  ///< Stamps are of clock_.
  bool paced_;
  std::int64_t max_frames_;
  Console& console_;
  std::int64_t taken_ = 0;
  std::int64_t unreadable_ = 0;
  Status fault_status_ = Status::kOk;
  bool lost_ = false;
  Status open_status_ = Status::kOk;  ///< Of the last attempt to open a lost device.
  std::uint32_t restarts_ = 0;        ///< Said so far.
  StampPacer pacer_;
};

}  // namespace disflow::apps
