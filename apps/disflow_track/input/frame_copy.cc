// SPDX-License-Identifier: BSD-3-Clause
#include "input/frame_copy.h"

#include <cstring>

namespace disflow::apps {
namespace {

void CopyRows(const std::byte* source, std::ptrdiff_t stride_bytes, std::size_t row_bytes, int rows,
              std::byte* target) noexcept {
  for (int v = 0; v < rows; ++v) {
    std::memcpy(target + static_cast<std::size_t>(v) * row_bytes, source + v * stride_bytes,
                row_bytes);
  }
}

}  // namespace

void FrameCopy::Reserve(int width_px, int height_px, bool with_mask) {
  const std::size_t pixels =
      static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  depth_.resize(pixels * kLargestPixel_bytes);
  if (with_mask) mask_.resize(pixels);
}

void FrameCopy::Take(const DepthFrame& source) {
  frame_ = source;
  const DepthView& from = source.depth;
  const auto row_bytes = static_cast<std::size_t>(from.width_px * from.bytes_per_pixel());
  const auto rows = static_cast<std::size_t>(from.height_px);
  if (depth_.size() < rows * row_bytes) depth_.resize(rows * row_bytes);
  CopyRows(from.row(0), from.stride_bytes, row_bytes, from.height_px, depth_.data());
  frame_.depth.data = depth_.data();
  frame_.depth.stride_bytes = static_cast<std::ptrdiff_t>(row_bytes);
  if (!source.mask.given()) return;
  const auto mask_row = static_cast<std::size_t>(source.mask.width_px);
  const std::size_t mask_bytes = mask_row * static_cast<std::size_t>(source.mask.height_px);
  if (mask_.size() < mask_bytes) mask_.resize(mask_bytes);
  CopyRows(reinterpret_cast<const std::byte*>(source.mask.data), source.mask.stride_bytes, mask_row,
           source.mask.height_px, reinterpret_cast<std::byte*>(mask_.data()));
  frame_.mask.data = mask_.data();
  frame_.mask.stride_bytes = static_cast<std::ptrdiff_t>(mask_row);
}

}  // namespace disflow::apps
