// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/sensor_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "disflow/host/random.h"

namespace disflow::host {
namespace {

constexpr unsigned kQuantileBits = 12;
constexpr std::size_t kQuantiles = std::size_t{1} << kQuantileBits;
constexpr float kNoJump = -1.0F;

/// Inverse of the normal distribution function by bisection: slow and exact, used once.
float NormalQuantile(double probability) {
  double low = -8.0;
  double high = 8.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < probability ? low : high) = middle;
  }
  return static_cast<float>(0.5 * (low + high));
}

/// Pixels of one row that the second view cannot see, since something nearer hides them there.
class Shadow {
 public:
  /// Call from the right end of a row to its left end.
  [[nodiscard]] bool Covers(int u, float disparity_px) {
    const float in_second_view = static_cast<float>(u) - disparity_px;
    if (in_second_view >= leftmost_) return true;
    leftmost_ = in_second_view;
    return false;
  }

 private:
  float leftmost_ = std::numeric_limits<float>::max();
};

void PunchHoles(RandomNumbers& random, double blobs_share, int width, int height,
                std::span<float> depth_m) {
  const int blobs = static_cast<int>(blobs_share * width * height);
  for (int i = 0; i < blobs; ++i) {
    const int u0 = static_cast<int>(random.Uniform(0.0, width));
    const int v0 = static_cast<int>(random.Uniform(0.0, height));
    const double radius = random.Uniform(1.0, 2.5);
    const int reach = static_cast<int>(radius);
    for (int v = std::max(0, v0 - reach); v <= std::min(height - 1, v0 + reach); ++v) {
      for (int u = std::max(0, u0 - reach); u <= std::min(width - 1, u0 + reach); ++u) {
        if (std::hypot(u - u0, v - v0) > radius) continue;
        depth_m[static_cast<std::size_t>(v * width + u)] = 0.0F;
      }
    }
  }
}

}  // namespace

DisparityModel D415Model(double fx_px) {
  return {.focal_baseline_px_m = fx_px * 0.055,
          .std_px = 0.08,
          .step_px = 1.0 / 32.0,
          .lateral_std_px = 0.0,
          .hole_share = 0.002,
          .hole_blobs_share = 0.0002,
          .flying_share = 0.35,
          .edge_hole_share = 0.2};
}

DisparityModel KinectModel() {
  return {.focal_baseline_px_m = 580.0 * 0.075,
          .std_px = 0.06,
          .step_px = 1.0 / 8.0,
          .lateral_std_px = 0.6,
          .hole_share = 0.004,
          .hole_blobs_share = 0.0004,
          .flying_share = 0.0,
          .edge_hole_share = 0.5};
}

SensorNoise::SensorNoise(const DisparityModel& model, int width_px, int height_px,
                         std::uint64_t seed)
    : model_(model),
      width_(width_px),
      height_(height_px),
      seed_(seed),
      normal_quantiles_(kQuantiles),
      disparity_px_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
      edge_neighbour_px_(disparity_px_.size()) {
  for (std::size_t i = 0; i < kQuantiles; ++i) {
    normal_quantiles_[i] =
        NormalQuantile((static_cast<double>(i) + 0.5) / static_cast<double>(kQuantiles));
  }
}

void SensorNoise::MarkEdges() {
  constexpr float kJump_px = 1.0F;
  std::fill(edge_neighbour_px_.begin(), edge_neighbour_px_.end(), kNoJump);
  const auto compare = [this](std::size_t a, std::size_t b) {
    if (std::abs(disparity_px_[a] - disparity_px_[b]) <= kJump_px) return;
    edge_neighbour_px_[a] = disparity_px_[b];
    edge_neighbour_px_[b] = disparity_px_[a];
  };
  const auto width = static_cast<std::size_t>(width_);
  for (std::size_t pixel = 0; pixel + 1 < disparity_px_.size(); ++pixel) {
    if ((pixel + 1) % width != 0) compare(pixel, pixel + 1);
    if (pixel + width < disparity_px_.size()) compare(pixel, pixel + width);
  }
}

float SensorNoise::MeasurePixel(std::size_t pixel, int u, BitSource& bits) const {
  const auto chance = [&bits](double share) {
    constexpr unsigned kBits = 16;
    return static_cast<double>(bits.Take(kBits)) < share * (1U << kBits);
  };
  const auto normal = [this, &bits] { return normal_quantiles_[bits.Take(kQuantileBits)]; };
  const bool nothing_there = disparity_px_[pixel] <= 0.0F;
  if (nothing_there || chance(model_.hole_share)) return 0.0F;
  float disparity_px = disparity_px_[pixel];
  if (model_.lateral_std_px > 0.0) {
    const auto shift =
        static_cast<int>(std::lround(static_cast<float>(model_.lateral_std_px) * normal()));
    const int shown = std::clamp(u + shift, 0, width_ - 1);
    disparity_px =
        disparity_px_[pixel + static_cast<std::size_t>(shown) - static_cast<std::size_t>(u)];
  }
  const float neighbour_px = edge_neighbour_px_[pixel];
  if (neighbour_px != kNoJump) {
    if (chance(model_.edge_hole_share)) return 0.0F;
    if (chance(model_.flying_share)) {
      constexpr unsigned kBits = 8;
      const float share = static_cast<float>(bits.Take(kBits)) / static_cast<float>(1U << kBits);
      disparity_px += share * (neighbour_px - disparity_px);
    }
  }
  disparity_px += static_cast<float>(model_.std_px) * normal();
  const auto step_px = static_cast<float>(model_.step_px);
  // Not std::round, which is a call on plain x86-64; disparities are not negative here.
  const float steps = static_cast<float>(static_cast<int>(disparity_px / step_px + 0.5F));
  const float rounded_px = steps * step_px;
  // So far away that the disparity vanishes in the noise.
  if (!(rounded_px > 0.0F)) return 0.0F;
  return static_cast<float>(model_.focal_baseline_px_m) / rounded_px;
}

void SensorNoise::Apply(int frame, std::span<const float> inverse_depth_per_m,
                        std::span<float> depth_m) {
  constexpr std::uint64_t kFirstStream = 1000;  // clear of the streams of the motions
  RandomNumbers random(seed_, kFirstStream + static_cast<std::uint64_t>(frame));
  const auto focal_baseline = static_cast<float>(model_.focal_baseline_px_m);
  for (std::size_t i = 0; i < disparity_px_.size(); ++i) {
    disparity_px_[i] = focal_baseline * inverse_depth_per_m[i];
  }
  MarkEdges();
  BitSource bits(random);
  for (int v = 0; v < height_; ++v) {
    const std::size_t row = static_cast<std::size_t>(v) * static_cast<std::size_t>(width_);
    Shadow shadow;
    for (int u = width_ - 1; u >= 0; --u) {
      const std::size_t pixel = row + static_cast<std::size_t>(u);
      const bool hidden = shadow.Covers(u, disparity_px_[pixel]);
      depth_m[pixel] = hidden ? 0.0F : MeasurePixel(pixel, u, bits);
    }
  }
  PunchHoles(random, model_.hole_blobs_share, width_, height_, depth_m);
}

}  // namespace disflow::host
