// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/sensor_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "disflow/host/random.h"

namespace disflow::host {
namespace {

constexpr float kNoJump = -1.0F;

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

DisparityModel WhiteModel(double fx_px) {
  return {.focal_baseline_px_m = fx_px * 0.055,
          .std_px = 0.08,
          .step_px = 1.0 / 32.0,
          .lateral_std_px = 0.0,
          .hole_share = 0.002,
          .hole_blobs_share = 0.0002,
          .flying_share = 0.35,
          .edge_hole_share = 0.2};
}

DisparityModel D415Model(double fx_px, int width_px) {
  const double scale = width_px / 640.0;
  DisparityModel model = WhiteModel(fx_px);
  model.image_noise = {
      .kernel_std_px = 1.5 * scale, .rest_correlation = 0.7, .layer_px = 1.0 * scale};
  // Two pixels outside the right outline 53 % of the rows still show the object, four outside 11 %.
  model.fattening_px = 2.115 * scale;
  model.fattening_std_px = 1.536 * scale;
  return model;
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
      disparity_px_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
      shown_px_(disparity_px_.size()),
      edge_neighbour_px_(disparity_px_.size()) {
  if (model.image_noise.kernel_std_px > 0.0)
    image_noise_.emplace(model.image_noise, width_px, height_px, seed);
}

void SensorNoise::Fatten() {
  constexpr float kJump_px = 2.0F;
  // Matched windows reach over an outline on all sides; on the left, the pixels beside it are
  // hidden from the second view and mostly dropped.
  struct Side {
    int du;
    int dv;
    double share;
  };
  constexpr std::array<Side, 4> kSides{Side{1, 0, 1.0}, Side{-1, 0, 0.3}, Side{0, 1, 0.5},
                                       Side{0, -1, 0.5}};
  const auto index = [this](int u, int v) {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(u);
  };
  const auto inside = [this](int u, int v) {
    return u >= 0 && v >= 0 && u < width_ && v < height_;
  };
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const float near_px = disparity_px_[index(u, v)];
      for (const auto& [du, dv, share] : kSides) {
        if (!inside(u + du, v + dv)) continue;
        if (near_px - disparity_px_[index(u + du, v + dv)] <= kJump_px) continue;
        const double noise = static_cast<double>(image_noise_->At(u, v, near_px, 1));
        const int reach =
            static_cast<int>(share * (model_.fattening_px + model_.fattening_std_px * noise));
        for (int k = 1; k <= reach && inside(u + k * du, v + k * dv); ++k) {
          float& shown_px = shown_px_[index(u + k * du, v + k * dv)];
          shown_px = std::max(shown_px, near_px);
        }
      }
    }
  }
}

void SensorNoise::MarkEdges() {
  constexpr float kJump_px = 1.0F;
  std::fill(edge_neighbour_px_.begin(), edge_neighbour_px_.end(), kNoJump);
  const auto compare = [this](std::size_t a, std::size_t b) {
    if (std::abs(shown_px_[a] - shown_px_[b]) <= kJump_px) return;
    edge_neighbour_px_[a] = shown_px_[b];
    edge_neighbour_px_[b] = shown_px_[a];
  };
  const auto width = static_cast<std::size_t>(width_);
  for (std::size_t pixel = 0; pixel + 1 < shown_px_.size(); ++pixel) {
    if ((pixel + 1) % width != 0) compare(pixel, pixel + 1);
    if (pixel + width < shown_px_.size()) compare(pixel, pixel + width);
  }
}

float SensorNoise::MeasurePixel(int u, int v, BitSource& bits) const {
  const std::size_t pixel =
      static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  const auto chance = [&bits](double share) {
    constexpr unsigned kBits = 16;
    return static_cast<double>(bits.Take(kBits)) < share * (1U << kBits);
  };
  const auto normal = [this, &bits] { return normal_.Draw(bits); };
  const bool nothing_there = shown_px_[pixel] <= 0.0F;
  if (nothing_there || chance(model_.hole_share)) return 0.0F;
  float disparity_px = shown_px_[pixel];
  if (model_.lateral_std_px > 0.0) {
    const auto shift =
        static_cast<int>(std::lround(static_cast<float>(model_.lateral_std_px) * normal()));
    const int shown = std::clamp(u + shift, 0, width_ - 1);
    disparity_px = shown_px_[pixel + static_cast<std::size_t>(shown) - static_cast<std::size_t>(u)];
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
  const float error = image_noise_ ? image_noise_->At(u, v, disparity_px) : normal();
  disparity_px += static_cast<float>(model_.std_px) * error;
  const auto step_px = static_cast<float>(model_.step_px);
  // Not std::round, which is a call on plain x86-64; disparities are not negative here.
  // NOLINTNEXTLINE(bugprone-incorrect-roundings)
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
  shown_px_ = disparity_px_;
  if (image_noise_) {
    image_noise_->StartFrame(frame);
    Fatten();
  }
  MarkEdges();
  BitSource bits(random);
  for (int v = 0; v < height_; ++v) {
    const std::size_t row = static_cast<std::size_t>(v) * static_cast<std::size_t>(width_);
    Shadow shadow;
    for (int u = width_ - 1; u >= 0; --u) {
      const std::size_t pixel = row + static_cast<std::size_t>(u);
      const bool fattened = shown_px_[pixel] > disparity_px_[pixel];
      const bool hidden = shadow.Covers(u, disparity_px_[pixel]) && !fattened;
      depth_m[pixel] = hidden ? 0.0F : MeasurePixel(u, v, bits);
    }
  }
  PunchHoles(random, model_.hole_blobs_share, width_, height_, depth_m);
}

}  // namespace disflow::host
