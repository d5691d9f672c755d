// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "disflow/field/gp_workspace.h"
#include "gp_patch.h"

/// @file
/// LocalGp on shapes whose true distance is known.

namespace disflow::testing {
namespace {

float Angle_rad(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Samples on the plane z = 0.
Patch PlanePatch(float radius_m, const Vec3& assumed_normal) {
  Patch patch{{}, Vec3::Zero(), assumed_normal};
  for (int i = 0; i < kSamples; ++i) {
    const Vec2 xy = DiscPoint(i, kSamples, radius_m);
    patch.samples.push_back(
        {Vec3(xy.x(), xy.y(), 0.0F), Vec3::UnitZ(), kValueVariance_m2, kNormalVariance});
  }
  return patch;
}

class OnSphere : public ::testing::TestWithParam<float> {
 protected:
  OnSphere() { trained_ = patch_.TrainInto(workspace_, gp_); }

  float radius_m_ = GetParam();
  Patch patch_ = SpherePatch(radius_m_, 0.015F);
  Workspace workspace_;
  Gp gp_;
  bool trained_;
};

TEST_P(OnSphere, NearTheSurface_DistanceAndNormalAreTrue) {
  ASSERT_TRUE(trained_);
  for (int i = 0; i < 60; ++i) {
    const Vec2 xy = DiscPoint(i, 60, 0.014F);
    const Vec3 outward =
        Vec3(xy.x(), xy.y(), std::sqrt(radius_m_ * radius_m_ - xy.squaredNorm())) / radius_m_;
    for (const float height_m : {-0.003F, -0.001F, 0.0F, 0.001F, 0.003F}) {
      const Prediction mean = Predict(gp_, (radius_m_ + height_m) * outward);
      EXPECT_NEAR(mean.distance_m, height_m, 2e-4F + 0.05F * std::abs(height_m));
      // Noise is assumed, so part of the way from the plane to the sphere is left.
      const float bend_rad = Angle_rad(outward, patch_.normal);
      EXPECT_LT(Angle_rad(mean.gradient, outward), 0.02F + 0.25F * bend_rad);
      EXPECT_NEAR(mean.gradient.norm(), 1.0F, 0.1F);
    }
  }
}

TEST_P(OnSphere, PreciseSamples_AreReproduced) {
  for (GpTrainingSample& sample : patch_.samples) {
    sample.value_variance_m2 = 1e-10F;
    sample.normal_variance = 1e-4F;
  }
  ASSERT_TRUE(patch_.TrainInto(workspace_, gp_));
  for (const GpTrainingSample& sample : patch_.samples) {
    const Prediction mean = Predict(gp_, sample.position_m);
    EXPECT_LT(std::abs(mean.distance_m), 1e-5F);
    EXPECT_LT(Angle_rad(mean.gradient, sample.normal), 0.01F);
  }
}

TEST_P(OnSphere, SignChangesAcrossTheSurface) {
  ASSERT_TRUE(trained_);
  const Vec3 pole(0.0F, 0.0F, radius_m_);
  EXPECT_GT(Predict(gp_, pole + Vec3(0.0F, 0.0F, 0.01F)).distance_m, 0.008F);
  EXPECT_LT(Predict(gp_, pole - Vec3(0.0F, 0.0F, 0.01F)).distance_m, -0.008F);
}

INSTANTIATE_TEST_SUITE_P(Radii_m, OnSphere, ::testing::Values(0.03F, 0.05F, 0.1F, 1.0F),
                         [](const auto& radius) { return "Case" + std::to_string(radius.index); });

TEST(OnPlane, RightPrior_IsExactEverywhere) {
  const Patch patch = PlanePatch(0.015F, Vec3::UnitZ());
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  for (const Vec3& x_m : QueryPoints(patch)) {
    const Prediction mean = Predict(gp, x_m);
    EXPECT_FLOAT_EQ(mean.distance_m, x_m.z());
    EXPECT_LT((mean.gradient - Vec3::UnitZ()).norm(), 1e-6F);
  }
}

TEST(OnPlane, WronglyTiltedPrior_IsCorrectedByTheSamples) {
  const float tilt_rad = 0.2F;
  const Patch patch = PlanePatch(0.015F, Vec3(std::sin(tilt_rad), 0.0F, std::cos(tilt_rad)));
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  for (int i = 0; i < 40; ++i) {
    const Vec2 xy = DiscPoint(i, 40, 0.013F);
    for (const float height_m : {-0.004F, 0.0F, 0.004F}) {
      const Prediction mean = Predict(gp, Vec3(xy.x(), xy.y(), height_m));
      EXPECT_NEAR(mean.distance_m, height_m, 2e-4F + 0.03F * std::abs(height_m));
      EXPECT_LT(Angle_rad(mean.gradient, Vec3::UnitZ()), 0.05F);
    }
  }
}

TEST(OnPlane, NoisySamples_AreAveragedAndTheVarianceSaysHowWell) {
  constexpr int kDraws = 400;
  std::mt19937 random(11);
  std::normal_distribution<float> normal;
  Workspace workspace;
  double squared_m2 = 0.0;
  double claimed_m2 = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Patch patch = PlanePatch(0.015F, Vec3::UnitZ());
    for (GpTrainingSample& sample : patch.samples) {
      sample.position_m.z() += std::sqrt(kValueVariance_m2) * normal(random);
      sample.normal.x() += std::sqrt(kNormalVariance) * normal(random);
      sample.normal.y() += std::sqrt(kNormalVariance) * normal(random);
    }
    Gp gp;
    ASSERT_TRUE(patch.TrainInto(workspace, gp));
    const auto error_m = static_cast<double>(Predict(gp, Vec3::Zero()).distance_m);
    squared_m2 += error_m * error_m;
    claimed_m2 += static_cast<double>(gp.SurfaceVariance());
  }
  EXPECT_LT(squared_m2, 0.5 * kDraws * static_cast<double>(kValueVariance_m2)) << "averaged";
  // The prior allows for bumps that a plane does not have, so the claim may only be cautious.
  EXPECT_LT(squared_m2, 1.2 * claimed_m2);
  EXPECT_GT(squared_m2, 0.2 * claimed_m2);
}

/// A face of a box, its edge 6 mm beside the patch's centre: samples end there.
TEST(OnBoxFace, UpToTheEdge_DistanceIsThatToTheFace) {
  constexpr float kEdge_m = 0.006F;
  constexpr float kTop_m = 0.04F;
  const Vec3 assumed = Vec3(0.1F, 0.05F, 1.0F).normalized();
  Patch patch{{}, Vec3(0.0F, 0.0F, kTop_m), assumed};
  for (int i = 0; i < kSamples; ++i) {
    const Vec2 xy = DiscPoint(i, kSamples, 0.014F);
    const float x_m = std::min(xy.x(), kEdge_m - 1e-4F);
    patch.samples.push_back(
        {Vec3(x_m, xy.y(), kTop_m), Vec3::UnitZ(), kValueVariance_m2, kNormalVariance});
  }
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  for (const float x_m : {-0.01F, -0.005F, 0.0F, 0.003F, kEdge_m}) {
    for (const float y_m : {-0.008F, 0.0F, 0.008F}) {
      for (const float height_m : {-0.003F, 0.0F, 0.003F}) {
        const Prediction mean = Predict(gp, Vec3(x_m, y_m, kTop_m + height_m));
        EXPECT_NEAR(mean.distance_m, height_m, 2e-4F + 0.03F * std::abs(height_m));
        EXPECT_LT(Angle_rad(mean.gradient, Vec3::UnitZ()), 0.05F);
      }
    }
  }
}

TEST(OnWave, CrestsAndTroughs_LieOnTheSurface) {
  // Curved on purpose: a plane alone could not do it.
  Patch patch = PlanePatch(0.015F, Vec3::UnitZ());
  for (GpTrainingSample& sample : patch.samples) {
    const float slope = 0.15F * std::cos(300.0F * sample.position_m.x());
    sample.position_m.z() = 0.0005F * std::sin(300.0F * sample.position_m.x());
    sample.normal = Vec3(-slope, 0.0F, 1.0F).normalized();
  }
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  for (const GpTrainingSample& sample : patch.samples)
    EXPECT_LT(std::abs(Predict(gp, sample.position_m).distance_m), 2e-4F);
}

}  // namespace
}  // namespace disflow::testing
