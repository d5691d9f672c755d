// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "disflow/hal/depth_sensor.h"
#include "disflow/posix/camera/camera_address.h"
#include "disflow/posix/camera/camera_description.h"
#include "disflow/posix/camera/video_kernel.h"

namespace disflow::posix {

/// A depth camera behind a V4L2 device. What it does in which case: docs/cameras.md.
///
/// Frames are used where the driver wrote them (converted formats: in memory got by Open()). Next()
/// delivers the newest good frame; older ones go back to the driver and are counted as skipped. It
/// does not allocate.
class V4l2Sensor final : public hal::DepthSensor {
 public:
  /// @param address Of kind kV4l2.
  /// @param description Intrinsics, image size and unit where the address does not say them.
  /// @param kernel Outlives this.
  /// @param sys_root, dev_root Where sysfs and devices are mounted; texts outlive this.
  V4l2Sensor(const CameraAddress& address, const CameraDescription& description,
             VideoKernel& kernel = LinuxVideoKernel(), const char* sys_root = "/sys",
             const char* dev_root = "/dev");
  ~V4l2Sensor();

  /// @return The DMABUF behind a frame that is still valid, for another device to read; owned by
  /// the sensor. -1 if the driver exports none or the frame was converted.
  [[nodiscard]] int Dmabuf(const DepthFrame& frame) const noexcept;

 private:
  struct State;

  hal::Fault DoOpen() noexcept override;
  hal::Fault DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept override;
  void DoClose() noexcept override;
  [[nodiscard]] hal::SensorInfo DoInfo() const noexcept override;
  [[nodiscard]] hal::SensorCounters DoCounters() const noexcept override;

  std::unique_ptr<State> state_;
};

}  // namespace disflow::posix
