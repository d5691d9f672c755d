// SPDX-License-Identifier: BSD-3-Clause
#include "surface_calibration.h"

#include <gtest/gtest.h>

#include <random>

#include "sphere_mesh.h"

namespace disflow::apps {
namespace {

constexpr double kRadius_m = 0.05;

/// A sphere whose vertices are off by what `std_of` says, times the standard normal distribution.
template <class StdOf>
Surface NoisySphere(double stated_over_true, StdOf&& std_of) {
  Surface sphere = MakeSphere(kRadius_m, Vec3d::Zero());
  std::mt19937 random(7);
  std::normal_distribution<double> gaussian;
  for (std::size_t i = 0; i < sphere.vertices.size(); ++i) {
    const double std_m = std_of(sphere.vertices[i]);
    sphere.vertices[i] += std_m * gaussian(random) * sphere.normals[i];
    sphere.stds_m.push_back(stated_over_true * std_m);
  }
  return sphere;
}

std::optional<SurfaceCalibration> Calibrate(const Surface& mesh,
                                            const std::vector<bool>& seen = {}) {
  const Surface model = MakeSphere(kRadius_m, Vec3d::Zero());
  return CalibrateSurface(mesh, NearestSurface(model, SampleSurface(model, 20000)), seen);
}

double OneMillimetre(const Vec3d&) { return 0.001; }

TEST(SurfaceCalibrationTest, TruthfulStandardDeviation_HasTheSharesOfTheNormalDistribution) {
  const auto c = Calibrate(NoisySphere(1.0, OneMillimetre));
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->share_within[0], 0.683, 0.01);
  EXPECT_NEAR(c->share_within[1], 0.954, 0.01);
  EXPECT_NEAR(c->share_within[2], 0.997, 0.003);
  EXPECT_NEAR(c->std_m, 0.001, 1e-9);
  EXPECT_NEAR(c->error_m, 0.001, 2e-5);
}

TEST(SurfaceCalibrationTest, StandardDeviationOfHalfTheError_ShowsInBoth) {
  const auto c = Calibrate(NoisySphere(0.5, OneMillimetre));
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->share_within[0], 0.383, 0.01);  // of the normal distribution within 1/2
  EXPECT_NEAR(c->error_m / c->std_m, 2.0, 0.04);
}

TEST(SurfaceCalibrationTest, Bins_FollowWhatIsStated) {
  const auto c =
      Calibrate(NoisySphere(1.0, [](const Vec3d& x_m) { return x_m.z() > 0.0 ? 0.0002 : 0.001; }));
  ASSERT_TRUE(c);
  ASSERT_EQ(c->bins.size(), 10U);
  EXPECT_NEAR(c->bins.front().std_m, 0.0002, 1e-9);
  EXPECT_NEAR(c->bins.front().error_m, 0.0002, 2e-5);
  EXPECT_NEAR(c->bins.back().std_m, 0.001, 1e-9);
  EXPECT_NEAR(c->bins.back().error_m, 0.001, 1e-4);
}

TEST(SurfaceCalibrationTest, UnseenPart_IsNotJudged) {
  const Surface model = MakeSphere(kRadius_m, Vec3d::Zero());
  const std::vector<SurfacePoint> samples = SampleSurface(model, 20000);
  std::vector<bool> seen;
  for (const SurfacePoint& sample : samples) seen.push_back(sample.position.z() > 0.0);
  Surface mesh = NoisySphere(1.0, OneMillimetre);
  for (Vec3d& vertex : mesh.vertices) {
    if (vertex.z() < -0.01) vertex *= 2.0;  // far off, where nothing was seen
  }
  const auto c = Calibrate(mesh, seen);
  ASSERT_TRUE(c);
  EXPECT_NEAR(static_cast<double>(c->vertices), 0.5 * static_cast<double>(mesh.vertices.size()),
              0.02 * static_cast<double>(mesh.vertices.size()));
  EXPECT_NEAR(c->error_m, 0.001, 5e-5);
}

TEST(SurfaceCalibrationTest, NothingStatedOrNothingSeen_IsNoCalibration) {
  EXPECT_FALSE(Calibrate(MakeSphere(kRadius_m, Vec3d::Zero())));
  EXPECT_FALSE(Calibrate(NoisySphere(1.0, OneMillimetre), std::vector<bool>(20000, false)));
}

}  // namespace
}  // namespace disflow::apps
