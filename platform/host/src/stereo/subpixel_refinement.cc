// SPDX-License-Identifier: BSD-3-Clause
#include "subpixel_refinement.h"

#include <array>
#include <cmath>

namespace disflow::host {
namespace {

constexpr int kReach_px = 3;
constexpr int kSide_px = 2 * kReach_px + 1;
constexpr double kWindowStd_px = 1.5;
constexpr int kIterations = 3;
constexpr float kMaxShift_px = 1.0F;
constexpr float kMinCorrelation = 0.3F;

using Line = std::array<float, kSide_px>;

Line WindowWeights() {
  Line weights{};
  double sum = 0.0;
  for (int i = 0; i < kSide_px; ++i) {
    const double offset = (i - kReach_px) / kWindowStd_px;
    sum += std::exp(-0.5 * offset * offset);
  }
  for (int i = 0; i < kSide_px; ++i) {
    const double offset = (i - kReach_px) / kWindowStd_px;
    weights[static_cast<std::size_t>(i)] =
        static_cast<float>(std::exp(-0.5 * offset * offset) / sum);
  }
  return weights;
}

/// Weights of four neighbouring pixels for value and slope of the cubic through them
/// (Catmull-Rom), at `t` between the second and the third.
struct Cubic {
  std::array<float, 4> value;
  std::array<float, 4> slope;

  explicit Cubic(float t)
      : value{0.5F * t * (-1.0F + t * (2.0F - t)), 0.5F * (2.0F + t * t * (-5.0F + 3.0F * t)),
              0.5F * t * (1.0F + t * (4.0F - 3.0F * t)), 0.5F * t * t * (t - 1.0F)},
        slope{0.5F * (-1.0F + t * (4.0F - 3.0F * t)), 0.5F * t * (-10.0F + 9.0F * t),
              0.5F * (1.0F + t * (8.0F - 9.0F * t)), 0.5F * t * (3.0F * t - 2.0F)} {}
};

/// Weighted sums over a window of the left image, the right one and its slope.
struct Sums {
  float l = 0.0F, r = 0.0F, s = 0.0F;
  float ll = 0.0F, rr = 0.0F, lr = 0.0F, ss = 0.0F, ls = 0.0F, rs = 0.0F;
};

Sums SumWindow(const StereoPair& pair, const Line& weights, int u, int v, float disparity_px) {
  const float at = static_cast<float>(u) - disparity_px;
  const int whole = static_cast<int>(at);
  const Cubic cubic(at - static_cast<float>(whole));
  Sums sums;
  for (int row = -kReach_px; row <= kReach_px; ++row) {
    const auto start = static_cast<std::ptrdiff_t>(v + row) * pair.width_px;
    const float* left = pair.left.data() + start + u - kReach_px;
    const float* right = pair.right.data() + start + whole - kReach_px - 1;
    const float row_weight = weights[static_cast<std::size_t>(row + kReach_px)];
    Sums line;
    for (int i = 0; i < kSide_px; ++i) {
      const float weight = weights[static_cast<std::size_t>(i)];
      const float l = left[i];
      const float r = cubic.value[0] * right[i] + cubic.value[1] * right[i + 1] +
                      cubic.value[2] * right[i + 2] + cubic.value[3] * right[i + 3];
      const float s = cubic.slope[0] * right[i] + cubic.slope[1] * right[i + 1] +
                      cubic.slope[2] * right[i + 2] + cubic.slope[3] * right[i + 3];
      line.l += weight * l;
      line.r += weight * r;
      line.s += weight * s;
      line.ll += weight * l * l;
      line.rr += weight * r * r;
      line.lr += weight * l * r;
      line.ss += weight * s * s;
      line.ls += weight * l * s;
      line.rs += weight * r * s;
    }
    sums.l += row_weight * line.l;
    sums.r += row_weight * line.r;
    sums.s += row_weight * line.s;
    sums.ll += row_weight * line.ll;
    sums.rr += row_weight * line.rr;
    sums.lr += row_weight * line.lr;
    sums.ss += row_weight * line.ss;
    sums.ls += row_weight * line.ls;
    sums.rs += row_weight * line.rs;
  }
  return sums;
}

/// One pixel's disparity; < 0 if there is none.
float Refine(const StereoPair& pair, const Line& weights, int u, int v, float first_px) {
  float disparity_px = first_px;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const float at = static_cast<float>(u) - disparity_px;
    constexpr auto kMargin_px = static_cast<float>(kReach_px + 1);
    if (at < kMargin_px || at >= static_cast<float>(pair.width_px - kReach_px - 3)) return -1.0F;
    const Sums sums = SumWindow(pair, weights, u, v, disparity_px);
    const float left_variance = sums.ll - sums.l * sums.l;
    const float right_variance = sums.rr - sums.r * sums.r;
    const float slope_variance = sums.ss - sums.s * sums.s;
    constexpr float kLeastVariance = 0.5F;
    if (left_variance < kLeastVariance || right_variance < kLeastVariance ||
        slope_variance < kLeastVariance) {
      return -1.0F;
    }
    const float covariance = sums.lr - sums.l * sums.r;
    const float correlation = covariance / std::sqrt(left_variance * right_variance);
    if (correlation < kMinCorrelation) return -1.0F;
    const float contrast = std::sqrt(left_variance / right_variance);
    const float left_slope = sums.ls - sums.l * sums.s;
    const float right_slope = sums.rs - sums.r * sums.s;
    // A larger disparity reads the right image farther left, hence the sign.
    disparity_px -= (left_slope - contrast * right_slope) / (contrast * slope_variance);
    if (!(std::abs(disparity_px - first_px) <= kMaxShift_px)) return -1.0F;
  }
  return disparity_px;
}

}  // namespace

void RefineDisparities(const StereoPair& pair, std::vector<float>& disparity_px) {
  const Line weights = WindowWeights();
  for (int v = 0; v < pair.height_px; ++v) {
    for (int u = 0; u < pair.width_px; ++u) {
      float& disparity =
          disparity_px[static_cast<std::size_t>(v) * static_cast<std::size_t>(pair.width_px) +
                       static_cast<std::size_t>(u)];
      const bool whole_window = u >= kReach_px && v >= kReach_px && u + kReach_px < pair.width_px &&
                                v + kReach_px < pair.height_px;
      // Without a whole window the matcher's own disparity has to do.
      if (disparity < 0.0F || !whole_window) continue;
      disparity = Refine(pair, weights, u, v, disparity);
    }
  }
}

}  // namespace disflow::host
