// SPDX-License-Identifier: BSD-3-Clause
#include "visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sphere_mesh.h"

namespace disflow::apps {
namespace {

constexpr int kWidth_px = 64;
constexpr int kHeight_px = 48;

/// A camera that looks at a wall 1 m away.
class VisibilityTest : public testing::Test {
 protected:
  VisibilityTest() : pixels_(static_cast<std::size_t>(kWidth_px * kHeight_px), 1.0F) {
    frame_.camera = {100.0F, 100.0F, 31.5F, 23.5F};
  }

  bool Sees(const Vec3d& x_c, const Vec3d& normal = Vec3d(0, 0, -1)) {
    frame_.depth = {pixels_.data(), kWidth_px, kHeight_px, 4 * kWidth_px, DepthFormat::kFloat32};
    std::vector<bool> seen(1, false);
    SurfacePoint point;
    point.position = x_c;
    point.normal = normal;
    MarkSeen(frame_, TruePose(), {point}, seen);
    return seen[0];
  }

  std::vector<float> pixels_;
  DepthFrame frame_;
};

TEST_F(VisibilityTest, PointOnTheImagedSurface_IsSeen) {
  EXPECT_TRUE(Sees({0.0, 0.0, 1.0}));
  EXPECT_TRUE(Sees({0.2, -0.1, 1.004}));
}

TEST_F(VisibilityTest, PointBehindOrBeforeTheImagedSurface_IsNotSeen) {
  EXPECT_FALSE(Sees({0.0, 0.0, 1.006}));
  EXPECT_FALSE(Sees({0.0, 0.0, 0.994}));
}

TEST_F(VisibilityTest, PointOutsideOfTheImageOrBehindTheCamera_IsNotSeen) {
  EXPECT_FALSE(Sees({0.4, 0.0, 1.0}));
  EXPECT_FALSE(Sees({0.0, -0.3, 1.0}));
  EXPECT_FALSE(Sees({0.0, 0.0, -1.0}));
  EXPECT_FALSE(Sees({0.0, 0.0, 0.0}));
  EXPECT_FALSE(Sees({1e30, 1e30, 1.0}));
}

TEST_F(VisibilityTest, SurfaceThatFacesAway_IsNotSeen) {
  EXPECT_FALSE(Sees({0.0, 0.0, 1.0}, {0, 0, 1}));
}

TEST_F(VisibilityTest, UnknownNormal_IsJudgedByDepthAlone) {
  EXPECT_TRUE(Sees({0.0, 0.0, 1.0}, {0, 0, 0}));
}

TEST_F(VisibilityTest, PixelWithoutDepth_ShowsNothing) {
  for (const float hole : {0.0F, std::numeric_limits<float>::quiet_NaN(), -1.0F}) {
    pixels_.assign(pixels_.size(), hole);
    EXPECT_FALSE(Sees({0.0, 0.0, 1.0}));
  }
}

TEST_F(VisibilityTest, OnceSeen_StaysSeen) {
  pixels_.assign(pixels_.size(), 0.0F);
  frame_.depth = {pixels_.data(), kWidth_px, kHeight_px, 4 * kWidth_px, DepthFormat::kFloat32};
  std::vector<bool> seen(1, true);
  MarkSeen(frame_, TruePose(), {SurfacePoint()}, seen);
  EXPECT_TRUE(seen[0]);
}

TEST(VisibilityOfASphereTest, SeenPart_IsTheCapThatGeometrySays) {
  constexpr double kRadius_m = 0.05;
  constexpr double kDistance_m = 0.6;
  constexpr int kSide_px = 200;
  DepthFrame frame;
  frame.camera = {1000.0F, 1000.0F, 99.5F, 99.5F};
  std::vector<float> pixels;
  for (int v = 0; v < kSide_px; ++v) {
    for (int u = 0; u < kSide_px; ++u) {
      // Nearer solution of |z ray - centre| = radius.
      const Vec3d ray =
          frame.camera.Ray(static_cast<float>(u), static_cast<float>(v)).cast<double>();
      const double a = ray.squaredNorm();
      const double c = kDistance_m * kDistance_m - kRadius_m * kRadius_m;
      const double discriminant = kDistance_m * kDistance_m - a * c;
      const bool hit = discriminant >= 0.0;
      pixels.push_back(hit ? static_cast<float>((kDistance_m - std::sqrt(discriminant)) / a)
                           : 0.0F);
    }
  }
  frame.depth = {pixels.data(), kSide_px, kSide_px, 4 * kSide_px, DepthFormat::kFloat32};
  const auto points = SampleSurface(MakeSphere(kRadius_m, Vec3d::Zero()), 20000);
  std::vector<bool> seen(points.size(), false);
  MarkSeen(frame, TruePose(Mat3d::Identity(), Vec3d(0, 0, kDistance_m)), points, seen);
  const double share = static_cast<double>(std::count(seen.begin(), seen.end(), true)) / 20000.0;
  const double cap = 0.5 * (1.0 - kRadius_m / kDistance_m);
  EXPECT_LE(share, cap + 0.001);
  // At the rim the depth changes by more than the tolerance within a pixel.
  EXPECT_GE(share, cap - 0.02);
}

}  // namespace
}  // namespace disflow::apps
