// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "disflow/field/gp_workspace.h"
#include "gp_patch.h"

/// @file
/// LocalGp on input that no sane sensor gives: refused, or at least harmless.

namespace disflow::testing {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

void ExpectFinite(const Gp& gp, const Workspace& workspace, const Patch& patch) {
  for (const Vec3& x_m : QueryPoints(patch)) {
    const Prediction mean = Predict(gp, x_m);
    EXPECT_TRUE(std::isfinite(mean.distance_m));
    EXPECT_TRUE(mean.gradient.allFinite());
    EXPECT_TRUE(workspace.Covariance(gp, x_m).allFinite());
  }
}

TEST(LocalGpInput, ZeroedMemory_IsUntrained) {
  static Gp gp;
  EXPECT_FALSE(gp.trained());
  EXPECT_EQ(gp.size(), 0);
  Workspace workspace;
  EXPECT_FALSE(workspace.Factorise(gp));
}

TEST(LocalGpInput, NoSamples_AreRefusedAndForgetTheOld) {
  Patch patch = RandomPatch(1);
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  patch.samples.clear();
  EXPECT_FALSE(patch.TrainInto(workspace, gp));
  EXPECT_FALSE(gp.trained());
  EXPECT_FALSE(workspace.Factorise(gp));
}

TEST(LocalGpInput, MoreSamplesThanFit_AreRefused) {
  Workspace workspace;
  Gp gp;
  EXPECT_TRUE(RandomPatch(1, kSamples).TrainInto(workspace, gp));
  EXPECT_FALSE(RandomPatch(1, kSamples + 1).TrainInto(workspace, gp));
  EXPECT_FALSE(gp.trained());
}

TEST(LocalGpInput, NotFiniteAnywhere_IsRefused) {
  const std::vector<std::function<void(Patch&, float)>> places{
      [](Patch& p, float bad) { p.samples[7].position_m.y() = bad; },
      [](Patch& p, float bad) { p.samples[0].normal.x() = bad; },
      [](Patch& p, float bad) { p.samples[15].normal.z() = bad; },
      [](Patch& p, float bad) { p.samples[3].value_variance_m2 = bad; },
      [](Patch& p, float bad) { p.samples[15].normal_variance = bad; },
      [](Patch& p, float bad) { p.center_m.x() = bad; },
      [](Patch& p, float bad) { p.normal.z() = bad; }};
  Workspace workspace;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
      Patch patch = RandomPatch(2);
      places[i](patch, bad);
      Gp gp;
      EXPECT_FALSE(patch.TrainInto(workspace, gp)) << "place " << i << ", " << bad;
      EXPECT_FALSE(gp.trained());
    }
  }
}

TEST(LocalGpInput, LengthScaleOrAmplitudeThatIsNone_IsRefused) {
  Workspace workspace;
  Gp gp;
  EXPECT_FALSE(RandomPatch(2).TrainInto(workspace, gp, {0.0F, 0.25F}));
  EXPECT_FALSE(RandomPatch(2).TrainInto(workspace, gp, {kNan, 0.25F}));
  EXPECT_FALSE(RandomPatch(2).TrainInto(workspace, gp, {0.06F, kNan}));
}

TEST(LocalGpInput, SameSampleManyTimes_IsLikeOneOfLessNoise) {
  Patch duplicates = RandomPatch(3);
  const GpTrainingSample sample = duplicates.samples[0];
  for (GpTrainingSample& other : duplicates.samples) other = sample;
  Patch single = duplicates;
  single.samples.assign(1, sample);
  single.samples[0].value_variance_m2 /= static_cast<float>(kSamples);
  single.samples[0].normal_variance /= static_cast<float>(kSamples);
  Workspace workspace;
  Gp many;
  Gp one;
  ASSERT_TRUE(duplicates.TrainInto(workspace, many));
  ASSERT_TRUE(single.TrainInto(workspace, one));
  for (const Vec3& x_m : QueryPoints(duplicates)) {
    EXPECT_NEAR(Predict(many, x_m).distance_m, Predict(one, x_m).distance_m, 1e-5F);
    EXPECT_LT((Predict(many, x_m).gradient - Predict(one, x_m).gradient).norm(), 1e-3F);
  }
}

TEST(LocalGpInput, DuplicatesWithoutNoise_AreRefused) {
  Patch patch = RandomPatch(4);
  patch.samples[9] = patch.samples[2];
  for (GpTrainingSample& sample : patch.samples)
    sample.value_variance_m2 = sample.normal_variance = 0.0F;
  Workspace workspace;
  Gp gp;
  EXPECT_FALSE(patch.TrainInto(workspace, gp));
  EXPECT_FALSE(gp.trained());
}

TEST(LocalGpInput, NegativeVariance_IsRefusedWhenItOutweighsThePrior) {
  Patch patch = RandomPatch(4);
  patch.samples[5].normal_variance = -1.0F;
  Workspace workspace;
  Gp gp;
  EXPECT_FALSE(patch.TrainInto(workspace, gp));
}

TEST(LocalGpInput, ContradictingNormalsAtOnePlace_StayFinite) {
  Patch patch = RandomPatch(5);
  patch.samples[1] = patch.samples[0];
  patch.samples[1].normal = -patch.samples[0].normal;
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  ExpectFinite(gp, workspace, patch);
}

TEST(LocalGpInput, SamplesOnALine_StayFinite) {
  Patch patch = RandomPatch(6);
  for (std::size_t i = 0; i < patch.samples.size(); ++i)
    patch.samples[i].position_m = patch.center_m + 1e-3F * static_cast<float>(i) * Vec3::UnitX();
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  ExpectFinite(gp, workspace, patch);
}

TEST(LocalGpInput, SamplesFarApart_StayFinite) {
  Patch patch = RandomPatch(7);
  for (GpTrainingSample& sample : patch.samples) sample.position_m *= 1e4F;
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  ExpectFinite(gp, workspace, patch);
}

TEST(LocalGpInput, HugeVariance_LeavesThePriorPlane) {
  Patch patch = RandomPatch(8);
  for (GpTrainingSample& sample : patch.samples)
    sample.value_variance_m2 = sample.normal_variance = 1e12F;
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  const Vec3 x_m = patch.center_m + Vec3(0.01F, 0.02F, -0.01F);
  EXPECT_NEAR(Predict(gp, x_m).distance_m, patch.normal.dot(x_m - patch.center_m), 1e-6F);
}

}  // namespace
}  // namespace disflow::testing
