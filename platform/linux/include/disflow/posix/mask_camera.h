// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "disflow/posix/camera/v4l2_sensor.h"
#include "disflow/posix/mask_source.h"

namespace disflow::posix {

/// Masks that a V4L2 device delivers as 8-bit images (GREY), e.g. a loopback device into which
/// another program writes. A thread of its own takes them, so that nobody waits for the device; one
/// that goes away is waited for.
class MaskCamera final : public MaskSource {
 public:
  /// @param address Of ParseMaskCamera().
  /// @param kernel, sys_root, dev_root As of V4l2Sensor.
  MaskCamera(const std::string& name, const CameraAddress& address, int width_px, int height_px,
             std::int64_t max_age_ns, VideoKernel& kernel = LinuxVideoKernel(),
             const char* sys_root = "/sys", const char* dev_root = "/dev");
  ~MaskCamera() override;

 private:
  struct Mask {
    std::vector<std::uint8_t> pixels;
    StampNs stamp_ns = 0;
  };

  [[nodiscard]] Status DoNewest(Newest& newest) noexcept override;

  // Runs in the thread.
  void TakeAll() noexcept;
  void TakeOne() noexcept;
  void Report(Status status) noexcept;
  void Nap() const noexcept;

  V4l2Sensor sensor_;
  bool open_ = false;
  Mask incoming_;

  std::mutex mutex_;
  // Guarded by the mutex.
  Mask between_;
  bool is_new_ = false;
  Status status_ = Status::kNotFound;  ///< Why there is no mask, if there is none.

  Mask current_;  ///< Of the thread that calls Attach().
  bool has_current_ = false;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

/// Reads `v4l2:/dev/NAME` or `v4l2:serial=TEXT`, with `?fps=HZ` if wanted: image size and format
/// are given.
/// @return kInvalidUri with what is wrong.
[[nodiscard]] hal::Fault ParseMaskCamera(const std::string& name, CameraAddress& address) noexcept;

}  // namespace disflow::posix
