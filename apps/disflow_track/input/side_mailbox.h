// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "disflow/hal/camera_pose_history.h"
#include "disflow/memory/fixed_vector.h"
#include "disflow/posix/mask_source.h"
#include "disflow/saturating.h"

/// @file
/// What another thread of this program hears about the depth images, on its way to the tracking
/// thread, which never waits longer than a few assignments take.

namespace disflow::apps {

/// Poses of the camera. The oldest make way.
class PoseMailbox {
 public:
  using Pose = Transform<World, hal::Body, double>;

  void Put(StampNs stamp_ns, const Pose& T_wb) {
    const std::lock_guard lock(mutex_);
    if (count_ == kCapacity) {
      first_ = (first_ + 1) % kCapacity;
      --count_;
    }
    poses_[(first_ + count_) % kCapacity] = {stamp_ns, T_wb};
    ++count_;
  }
  void MoveTo(hal::CameraPoseHistory& history) noexcept {
    const std::lock_guard lock(mutex_);
    for (; count_ > 0; --count_, first_ = (first_ + 1) % kCapacity) {
      // Refused poses are counted there.
      (void)history.Add(poses_[first_].first, poses_[first_].second, /*reset_counter=*/0);
    }
  }

 private:
  static constexpr std::size_t kCapacity = 128;

  std::mutex mutex_;
  std::array<std::pair<StampNs, Pose>, kCapacity> poses_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

/// The newest mask. Three buffers, so that neither side waits for the other's copying.
class MaskMailbox final : public posix::MaskSource {
 public:
  MaskMailbox(const std::string& name, int width_px, int height_px, std::int64_t max_age_ns)
      : MaskSource(name, width_px, height_px, max_age_ns) {
    const auto size = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    for (Mask& mask : masks_) mask.pixels.resize(size);
  }

  /// By another thread.
  /// @param pixels Rows `stride` apart; a mask that is not as large as the images is told as such.
  void Put(StampNs stamp_ns, std::int64_t width_px, std::int64_t height_px, std::size_t stride,
           std::span<const std::uint8_t> pixels) {
    Mask& mask = masks_[filling_];
    mask.stamp_ns = stamp_ns;
    const auto width = static_cast<std::size_t>(width_px_);
    const auto height = static_cast<std::size_t>(height_px_);
    mask.fits = width_px == width_px_ && height_px == height_px_ && stride >= width &&
                stride <= pixels.size() && pixels.size() / stride >= height;
    for (std::size_t v = 0; mask.fits && v < height; ++v) {
      const auto row = pixels.subspan(v * stride, width);
      std::copy(row.begin(), row.end(),
                mask.pixels.begin() + static_cast<std::ptrdiff_t>(v * width));
    }
    const std::lock_guard lock(mutex_);
    std::swap(filling_, between_);
    fresh_ = true;
  }

 private:
  struct Mask {
    StampNs stamp_ns = 0;
    bool fits = false;
    std::vector<std::uint8_t> pixels;
  };

  [[nodiscard]] Status DoNewest(Newest& newest) noexcept override {
    {
      const std::lock_guard lock(mutex_);
      if (fresh_) std::swap(between_, taken_);
      has_any_ = has_any_ || fresh_;
      fresh_ = false;
    }
    if (!has_any_) {
      AddSaturating(counters_.missing);
      return Status::kNotFound;
    }
    const Mask& mask = masks_[taken_];
    if (!mask.fits) {
      AddSaturating(counters_.wrong_size);
      return Status::kMaskSizeMismatch;
    }
    newest = {mask.pixels.data(), mask.stamp_ns};
    return Status::kOk;
  }

  std::array<Mask, 3> masks_;
  std::size_t filling_ = 0;  ///< The other thread's own.
  std::mutex mutex_;
  std::size_t between_ = 1;
  bool fresh_ = false;
  std::size_t taken_ = 2;  ///< The tracking thread's own.
  bool has_any_ = false;
};

}  // namespace disflow::apps
