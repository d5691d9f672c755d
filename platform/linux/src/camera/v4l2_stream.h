// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "camera_choice.h"
#include "camera_search.h"
#include "disflow/depth/depth_frame.h"
#include "disflow/hal/depth_sensor.h"
#include "disflow/saturating.h"
#include "frame_stamp.h"
#include "v4l2_buffers.h"
#include "v4l2_format.h"

namespace disflow::posix {

/// One open V4L2 device, from the negotiation to the last frame.
class V4l2Stream {
 public:
  /// Frames lent out at the same time.
  static constexpr int kHeldFrames = 2;
  static_assert(kHeldFrames + 2 <= int{V4l2Buffers::kNeeded}, "the driver needs two to go on");

  /// @param kernel, counters Outlive this.
  V4l2Stream(VideoKernel& kernel, hal::SensorCounters& counters) noexcept
      : kernel_(kernel), counters_(counters) {}
  V4l2Stream(const V4l2Stream&) = delete;
  V4l2Stream& operator=(const V4l2Stream&) = delete;

  /// Opens the device, agrees on format, size and rate, and starts.
  /// @param description Valid intrinsics; size 0 = the driver's.
  [[nodiscard]] hal::Fault Open(const VideoNode& node, const CameraAddress& address,
                                const CameraDescription& description);
  void Close() noexcept;
  [[nodiscard]] bool is_open() const noexcept { return fd_ >= 0; }

  /// See hal::DepthSensor::Next(). After kDeviceLost nothing more can come.
  [[nodiscard]] hal::Fault Next(std::int64_t timeout_ns, DepthFrame& frame) noexcept;

  [[nodiscard]] const StreamLayout& layout() const noexcept { return layout_; }
  [[nodiscard]] hal::StampPoint stamp_point() const noexcept { return stamp_point_; }
  /// @param data Start of a depth image that is lent out.
  [[nodiscard]] int Dmabuf(const void* data) const noexcept;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  [[nodiscard]] hal::Fault Prepare(const VideoNode& node, const CameraAddress& address,
                                   const CameraDescription& description);
  [[nodiscard]] hal::Fault TakeNewest(v4l2_buffer& newest) noexcept;
  [[nodiscard]] hal::Fault Inspect(const v4l2_buffer& buffer) noexcept;
  [[nodiscard]] hal::Fault Restart(const char* reason) noexcept;
  [[nodiscard]] hal::Fault DriverFailed(int error) noexcept;
  [[nodiscard]] hal::Fault Return(std::uint32_t index) noexcept;
  [[nodiscard]] hal::Fault Lend(const v4l2_buffer& buffer, DepthFrame& frame) noexcept;
  [[nodiscard]] const void* Image(std::uint32_t index) noexcept;
  [[nodiscard]] std::int64_t WatchdogNs() const noexcept;

  VideoKernel& kernel_;
  hal::SensorCounters& counters_;
  std::string name_;
  int fd_ = -1;
  StreamLayout layout_;
  float unit_m_ = 0.0F;
  PinholeCamera camera_;
  V4l2Buffers buffers_{kernel_};
  std::vector<std::uint16_t> converted_;  ///< One image per slot of held_, if converted at all.
  std::array<std::uint32_t, kHeldFrames> held_{};  ///< Buffers lent out, kNone = free.
  std::size_t slot_ = 0;                           ///< Of held_, the next to be used.
  SequenceCheck sequence_;
  hal::StampPoint stamp_point_ = hal::StampPoint::kUnknown;
  std::int64_t alive_ns_ = 0;  ///< When a frame came or the stream was started.
  int silent_restarts_ = 0;    ///< Since the last frame.
};

}  // namespace disflow::posix
