// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "disflow/hal/depth_sensor.h"
#include "disflow/posix/camera/camera_address.h"
#include "disflow/posix/camera/camera_description.h"

namespace disflow::posix {

/// A camera of libcamera that delivers 16-bit or packed raw images as depth. What it does in which
/// case: docs/cameras.md. Only one can be open in a process.
///
/// Unpacked formats are used where libcamera put them. libcamera itself allocates in its own
/// threads.
class LibcameraSensor final : public hal::DepthSensor {
 public:
  /// @param address Of kind kLibcamera.
  /// @param description Intrinsics, image size and unit where the address does not say them.
  LibcameraSensor(const CameraAddress& address, const CameraDescription& description);
  ~LibcameraSensor();

 private:
  struct State;

  hal::Fault DoOpen() noexcept override;
  hal::Fault DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept override;
  void DoClose() noexcept override;
  [[nodiscard]] hal::SensorInfo DoInfo() const noexcept override;
  [[nodiscard]] hal::SensorCounters DoCounters() const noexcept override;

  std::unique_ptr<State> state_;
};

/// Every camera of libcamera with its formats and sizes; text for people.
[[nodiscard]] std::string DescribeLibcameraCameras();

}  // namespace disflow::posix
