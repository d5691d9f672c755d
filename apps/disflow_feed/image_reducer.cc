// SPDX-License-Identifier: BSD-3-Clause
#include "image_reducer.h"

#include <algorithm>
#include <cmath>

#include "disflow/depth/depth_reader.h"

namespace disflow::apps {
namespace {

/// Pixels whose 1/z differs by more than this share from the median's show another surface.
constexpr float kSameSurface = 0.01F;
constexpr float kFarthest_m = 65535.0F * ImageReducer::kUnit_m;
constexpr float kNearest_m = 1e-3F;

int Ratio(int size_px, int limit_px) { return (size_px + limit_px - 1) / limit_px; }

}  // namespace

DepthFrame ImageReducer::Reduce(const DepthFrame& frame) {
  const int k = std::max({1, Ratio(frame.depth.width_px, max_width_px_),
                          Ratio(frame.depth.height_px, max_height_px_)});
  const int width = frame.depth.width_px / k;
  const int height = frame.depth.height_px / k;
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::size_t next = 0;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) pixels_[next++] = Block(frame, u * k, v * k, k);
  }
  DepthFrame reduced = frame;
  reduced.depth = {pixels_.data(),       width,  height, width * std::ptrdiff_t{2},
                   DepthFormat::kUint16, kUnit_m};
  reduced.mask = {};
  const auto scale = static_cast<float>(k);
  reduced.camera = {frame.camera.fx_px / scale, frame.camera.fy_px / scale,
                    (frame.camera.cx_px + 0.5F) / scale - 0.5F,
                    (frame.camera.cy_px + 0.5F) / scale - 0.5F};
  return reduced;
}

std::uint16_t ImageReducer::Block(const DepthFrame& frame, int u, int v, int k) {
  const DepthReader depth(frame.depth, kNearest_m, kFarthest_m);
  inverse_.clear();
  for (int dv = 0; dv < k; ++dv) {
    for (int du = 0; du < k; ++du) {
      const float z_m = depth.AtOrZero(u + du, v + dv);
      if (z_m > 0.0F) inverse_.push_back(1.0F / z_m);
    }
  }
  if (2 * inverse_.size() <= static_cast<std::size_t>(k) * static_cast<std::size_t>(k)) return 0;
  const auto middle = inverse_.begin() + static_cast<std::ptrdiff_t>((inverse_.size() - 1) / 2);
  std::nth_element(inverse_.begin(), middle, inverse_.end());
  const float median = *middle;
  float sum = 0.0F;
  float count = 0.0F;
  for (const float w : inverse_) {
    if (std::abs(w - median) > kSameSurface * median) continue;
    sum += w;
    count += 1.0F;
  }
  const float units = std::round(count / sum / kUnit_m);
  return units <= 65535.0F ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
}

}  // namespace disflow::apps
