// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/sensor_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace disflow::host {
namespace {

constexpr int kWidth_px = 320;
constexpr int kHeight_px = 240;
constexpr std::size_t kPixels = std::size_t{kWidth_px} * kHeight_px;
constexpr double kFocal_px = 614.7;

std::vector<float> Measure(const DisparityModel& model, const std::vector<float>& inverse_depth,
                           int frame = 0, std::uint64_t seed = 1) {
  SensorNoise noise(model, kWidth_px, kHeight_px, seed);
  std::vector<float> depth_m(kPixels);
  noise.Apply(frame, inverse_depth, depth_m);
  return depth_m;
}

std::vector<float> Wall(double depth_m) {
  return std::vector<float>(kPixels, static_cast<float>(1.0 / depth_m));
}

/// A near rectangle [100, 200) x [60, 180) before a wall.
std::vector<float> Step(double near_m, double far_m) {
  std::vector<float> inverse_depth = Wall(far_m);
  for (int v = 60; v < 180; ++v) {
    for (int u = 100; u < 200; ++u) {
      inverse_depth[static_cast<std::size_t>(v * kWidth_px + u)] = static_cast<float>(1.0 / near_m);
    }
  }
  return inverse_depth;
}

class NoiseOfDepth : public testing::TestWithParam<double> {};

TEST_P(NoiseOfDepth, White_DisparityErrorHasTheModelsDeviationAndNoBias) {
  const DisparityModel model = WhiteModel(kFocal_px);
  const double fb = model.focal_baseline_px_m;
  EXPECT_NEAR(fb, kFocal_px * 0.055, 1e-9);
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (const float depth_m : Measure(model, Wall(GetParam()))) {
    if (depth_m == 0.0F) continue;
    const double error_px = fb / static_cast<double>(depth_m) - fb / GetParam();
    sum += error_px;
    squares += error_px * error_px;
    ++count;
  }
  // Rounding to steps adds the variance of a uniform distribution.
  const double expected_px = std::sqrt(0.08 * 0.08 + 1.0 / (32.0 * 32.0 * 12.0));
  EXPECT_NEAR(std::sqrt(squares / count), expected_px, 0.02 * expected_px);
  EXPECT_NEAR(sum / count, 0.0, 4.0 * expected_px / std::sqrt(count));
}

TEST_P(NoiseOfDepth, White_DisparitiesAreMultiplesOfA32ndPixel) {
  const DisparityModel model = WhiteModel(kFocal_px);
  for (const float depth_m : Measure(model, Wall(GetParam()))) {
    if (depth_m == 0.0F) continue;
    const double steps = 32.0 * model.focal_baseline_px_m / static_cast<double>(depth_m);
    ASSERT_NEAR(steps, std::round(steps), 1e-3);
  }
}

TEST_P(NoiseOfDepth, Kinect_DisparitiesAreMultiplesOfAnEighthPixel) {
  const DisparityModel model = KinectModel();
  for (const float depth_m : Measure(model, Wall(GetParam()))) {
    if (depth_m == 0.0F) continue;
    const double steps = 8.0 * 43.5 / static_cast<double>(depth_m);
    ASSERT_NEAR(steps, std::round(steps), 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(At, NoiseOfDepth, testing::Values(0.5, 0.7123, 1.6),
                         [](const auto& depth_m) {
                           return std::to_string(std::lround(depth_m.param * 1e3)) + "mm";
                         });

TEST(SensorNoise, NeighboursOfWhiteNoise_AreIndependent) {
  const double depth_m = 0.7;
  const std::vector<float> measured = Measure(WhiteModel(kFocal_px), Wall(depth_m));
  double product = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i + 1 < kPixels; ++i) {
    if (measured[i] == 0.0F || measured[i + 1] == 0.0F) continue;
    const double here = static_cast<double>(measured[i]) - depth_m;
    product += here * (static_cast<double>(measured[i + 1]) - depth_m);
    square += here * here;
  }
  EXPECT_LT(std::abs(product / square), 0.03);
}

TEST(SensorNoise, Holes_AreFewAndThere) {
  const std::vector<float> measured = Measure(WhiteModel(kFocal_px), Wall(0.7));
  const auto holes = std::count(measured.begin(), measured.end(), 0.0F);
  EXPECT_GT(holes, static_cast<std::ptrdiff_t>(0.002 * kPixels));
  EXPECT_LT(holes, static_cast<std::ptrdiff_t>(0.01 * kPixels));
}

TEST(SensorNoise, Shadow_LiesOnTheLeftOfNearThings) {
  const DisparityModel model = WhiteModel(kFocal_px);
  const std::vector<float> measured = Measure(model, Step(0.6, 1.5));
  const int width = static_cast<int>(model.focal_baseline_px_m * (1.0 / 0.6 - 1.0 / 1.5));  // 33 px
  ASSERT_GT(width, 20);
  int valid_on_right = 0;
  for (int v = 70; v < 170; ++v) {
    for (int u = 100 - width; u < 100; ++u) {
      ASSERT_EQ(measured[static_cast<std::size_t>(v * kWidth_px + u)], 0.0F) << u << " " << v;
    }
    for (int u = 205; u < 200 + width; ++u) {
      valid_on_right += measured[static_cast<std::size_t>(v * kWidth_px + u)] > 0.0F ? 1 : 0;
    }
  }
  EXPECT_GT(valid_on_right, 100 * (width - 5) * 98 / 100);
}

TEST(SensorNoise, FlyingPixels_AreAtDepthJumpsOnly) {
  const double near_m = 0.6;
  const double far_m = 1.5;
  const std::vector<float> measured = Measure(WhiteModel(kFocal_px), Step(near_m, far_m));
  int flying_at_edge = 0;
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      const auto depth_m =
          static_cast<double>(measured[static_cast<std::size_t>(v * kWidth_px + u)]);
      const bool between = depth_m > near_m + 0.05 && depth_m < far_m - 0.15;
      const bool in_u = u >= 99 && u <= 200;
      const bool in_v = v >= 59 && v <= 180;
      const bool at_edge = (in_v && (std::abs(u - 99.5) < 1.0 || std::abs(u - 199.5) < 1.0)) ||
                           (in_u && (std::abs(v - 59.5) < 1.0 || std::abs(v - 179.5) < 1.0));
      if (between) {
        ASSERT_TRUE(at_edge) << u << " " << v << " " << depth_m;
        ++flying_at_edge;
      }
    }
  }
  EXPECT_GT(flying_at_edge, 50);
}

TEST(SensorNoise, SameSeedAndFrame_GiveTheSameBytesInAnyOrder) {
  const DisparityModel model = WhiteModel(kFocal_px);
  SensorNoise noise(model, kWidth_px, kHeight_px, 4);
  std::vector<float> third(kPixels);
  std::vector<float> again(kPixels);
  noise.Apply(3, Wall(0.7), third);
  noise.Apply(9, Wall(0.7), again);
  EXPECT_NE(third, again) << "frames must not share their noise";
  noise.Apply(3, Wall(0.7), again);
  EXPECT_EQ(third, again);
  EXPECT_NE(Measure(model, Wall(0.7), 3, 5), third) << "seeds must not share their noise";
}

TEST(SensorNoise, NothingThere_StaysNothing) {
  const std::vector<float> nothing(kPixels, 0.0F);
  for (const DisparityModel& model : {WhiteModel(kFocal_px), KinectModel()}) {
    EXPECT_EQ(Measure(model, nothing), nothing);
  }
}

}  // namespace
}  // namespace disflow::host
