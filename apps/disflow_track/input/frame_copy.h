// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "disflow/depth/depth_frame.h"

namespace disflow::apps {

/// A frame with its pixels in memory of its own, which is used again and again: a driver's buffers
/// are few, and their owner reuses them.
class FrameCopy {
 public:
  /// Bytes of a pixel, of whichever format.
  static constexpr std::size_t kLargestPixel_bytes = 4;

  FrameCopy() = default;
  FrameCopy(const FrameCopy&) = delete;
  FrameCopy& operator=(const FrameCopy&) = delete;

  /// Allocates for frames of this size. A larger one later is taken as well, but allocates.
  void Reserve(int width_px, int height_px, bool with_mask);
  void Take(const DepthFrame& source);
  /// The one taken last.
  [[nodiscard]] const DepthFrame& frame() const noexcept { return frame_; }

 private:
  DepthFrame frame_;
  std::vector<std::byte> depth_;
  std::vector<std::uint8_t> mask_;
};

}  // namespace disflow::apps
