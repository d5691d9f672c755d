// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace disflow::host {

/// What a slow and inexact segmentation network would deliver: every third frame a new mask, grown
/// and shrunk by 6 px in turn, held in between.
class SloppyMask {
 public:
  SloppyMask(int width_px, int height_px);

  /// @param frame Increasing from call to call.
  /// @param exact Mask of this frame, 0 or 255.
  void Update(int frame, std::span<const std::uint8_t> exact);
  [[nodiscard]] std::span<const std::uint8_t> mask() const { return mask_; }

  static constexpr int kReach_px = 6;
  static constexpr int kHeldFrames = 3;

 private:
  int width_;
  int height_;
  int period_ = -1;
  std::vector<std::uint8_t> rows_;
  std::vector<std::uint8_t> mask_;
};

}  // namespace disflow::host
