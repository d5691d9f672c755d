// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/fault.h"

namespace disflow::hal {

/// Which moment of a frame its stamp refers to. Moving things are imaged half an exposure after the
/// start of exposure, and one read-out time before the end of the frame.
enum class StampPoint : std::uint8_t {
  kUnknown,
  kStartOfExposure,
  kEndOfFrame,  ///< When the last byte had arrived.
};

/// What a sensor is and delivers; texts are owned by the sensor.
struct SensorInfo {
  const char* name = "";  ///< For people, e.g. "replay of box_fast, 300 frames".
  int width_px = 0;
  int height_px = 0;
  float rate_hz = 0.0F;
  bool live = false;  ///< true: frames come in real time and are lost if nobody takes them.
  StampPoint stamp_point = StampPoint::kUnknown;  ///< May be known only after the first frame.
  /// A frame's views stay valid until Next() has been called this many times more.
  int held_frames = 1;
  /// Stamps are nanoseconds since 1970 by the clock of whoever sends the frames, who may play a
  /// recording; else those of a live sensor are of this machine's CLOCK_MONOTONIC.
  bool epoch_stamps = false;

  /// @return Whether a stamp's age can be told by this machine's CLOCK_MONOTONIC.
  [[nodiscard]] bool has_monotonic_stamps() const noexcept { return live && !epoch_stamps; }
};

/// Frames that did and did not reach the tracker, counted since the sensor was constructed;
/// saturating.
struct SensorCounters {
  std::uint32_t frames = 0;        ///< Delivered by Next().
  std::uint32_t dropped = 0;       ///< Lost between sensor and Next(): gaps + skipped.
  std::uint32_t gaps = 0;          ///< Missing in the driver's sequence numbers.
  std::uint32_t skipped = 0;       ///< Passed over because a newer frame was already there.
  std::uint32_t corrupt = 0;       ///< Thrown away: flagged + short_frames, or a damaged file.
  std::uint32_t flagged = 0;       ///< Marked as erroneous by the driver.
  std::uint32_t short_frames = 0;  ///< Fewer bytes than the image has.
  std::uint32_t restarts = 0;      ///< Times the stream stalled or failed and was restarted.
  std::uint32_t reconnects = 0;    ///< Times the device went away and came back.
};

/// A source of depth frames. Public methods are fixed; implementations override the Do methods.
/// Not thread-safe. Neither constructing nor calling it from the base allocates.
class DepthSensor {
 public:
  DepthSensor(const DepthSensor&) = delete;
  DepthSensor& operator=(const DepthSensor&) = delete;

  /// Makes the sensor ready. Idempotent after success. After kDeviceLost it may be called again
  /// until the device is back.
  [[nodiscard]] Fault Open() noexcept { return DoOpen(); }

  /// Waits for the next frame. The frame's views stay valid until SensorInfo::held_frames more
  /// calls of Next(), or Close().
  /// @return kOk, kTimeout, kEndOfStream, kDeviceLost (call Open() again), kTruncated or kCorrupt
  /// (this frame is lost, the next call goes on), kNotOpen.
  [[nodiscard]] Fault Next(std::int64_t timeout_ns, DepthFrame& frame) noexcept {
    return DoNext(timeout_ns, frame);
  }

  /// Idempotent.
  void Close() noexcept { DoClose(); }

  [[nodiscard]] SensorInfo info() const noexcept { return DoInfo(); }
  [[nodiscard]] SensorCounters counters() const noexcept { return DoCounters(); }

 protected:
  DepthSensor() = default;
  // Not virtual: sensors are owned by their concrete type, and a virtual one would pull in operator
  // delete.
  ~DepthSensor() = default;

 private:
  virtual Fault DoOpen() noexcept = 0;
  virtual Fault DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept = 0;
  virtual void DoClose() noexcept = 0;
  [[nodiscard]] virtual SensorInfo DoInfo() const noexcept = 0;
  [[nodiscard]] virtual SensorCounters DoCounters() const noexcept = 0;
};

}  // namespace disflow::hal
