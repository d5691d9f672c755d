// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/sample_list.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <random>
#include <vector>

namespace disflow::testing {
namespace {

constexpr int kMost = 8;
using List = SampleList<kMost>;
static_assert(sizeof(List) == 16 * kMost + 20, "16 bytes per sample");

constexpr float kReach_m = 0.04F;
const Vec3 kOrigin_m(0.11F, -0.07F, 0.05F);
constexpr float kStep_m = kReach_m / 32767.0F;

List Started() {
  List list;
  list.Start(kOrigin_m, kReach_m);
  return list;
}

std::vector<ModelSample> RandomSamples(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  std::vector<ModelSample> samples;
  for (int i = 0; i < count; ++i) {
    const auto any = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
    samples.push_back({kOrigin_m + 0.99F * kReach_m * any(), any().normalized(), 3e-8F, 2e-3F,
                       static_cast<std::uint16_t>(i + 1)});
  }
  return samples;
}

TEST(SampleList, Samples_ComeBackInOrderAndNearlyUnchanged) {
  List list = Started();
  const auto samples = RandomSamples(kMost);
  for (const ModelSample& sample : samples) EXPECT_TRUE(list.push_back(sample));
  ASSERT_EQ(list.size(), kMost);
  std::size_t i = 0;
  for (const ModelSample& packed : list) {
    const ModelSample& sample = samples[i++];
    EXPECT_LT((packed.position_m - sample.position_m).cwiseAbs().maxCoeff(), 0.51F * kStep_m);
    EXPECT_LT((packed.normal - sample.normal).norm(), 7e-5F);
    EXPECT_NEAR(packed.variance_m2, sample.variance_m2, 1e-3F * sample.variance_m2);
    EXPECT_NEAR(packed.normal_variance, sample.normal_variance, 1e-3F * sample.normal_variance);
    EXPECT_EQ(packed.observations, sample.observations);
  }
}

TEST(SampleList, PushBeyondCapacity_IsRefusedAndChangesNothing) {
  List list = Started();
  const auto samples = RandomSamples(kMost + 1);
  for (int i = 0; i < kMost; ++i) EXPECT_TRUE(list.push_back(samples[static_cast<std::size_t>(i)]));
  EXPECT_TRUE(list.full());
  const Vec3 last_m = list.position_m(kMost - 1);
  EXPECT_FALSE(list.push_back(samples[kMost]));
  EXPECT_EQ(list.size(), kMost);
  EXPECT_EQ(list.position_m(kMost - 1), last_m);
}

TEST(SampleList, StartedAgain_IsEmpty) {
  List list = Started();
  EXPECT_TRUE(list.push_back(RandomSamples(1)[0]));
  list.Start(kOrigin_m, kReach_m);
  EXPECT_TRUE(list.empty());
  EXPECT_EQ(list.begin(), list.end());
}

TEST(SampleList, Distances_AreThoseOfTheSamples) {
  List list = Started();
  for (const ModelSample& sample : RandomSamples(5)) EXPECT_TRUE(list.push_back(sample));
  const Vec3 x_m = kOrigin_m + Vec3(0.01F, 0.02F, -0.005F);
  const Vec3 normal = Vec3(1.0F, 2.0F, -1.0F).normalized();
  const auto all = list.SquaredDistances(x_m);
  const auto across = list.SquaredDistancesAcross(x_m, normal);
  for (int i = 0; i < list.size(); ++i) {
    const Vec3 offset = x_m - list.position_m(i);
    const auto k = static_cast<std::size_t>(i);
    EXPECT_NEAR(all[k], offset.squaredNorm(), 1e-8F);
    EXPECT_NEAR(across[k], offset.cross(normal).squaredNorm(), 1e-8F);
  }
}

TEST(SampleList, WhatIsOutOfReach_IsMovedBackToIt) {
  List list = Started();
  ModelSample sample = RandomSamples(1)[0];
  sample.position_m = kOrigin_m + Vec3(1.0F, -5.0F, 0.01F);
  EXPECT_TRUE(list.push_back(sample));
  const Vec3 moved_m = kOrigin_m + Vec3(kReach_m, -kReach_m, 0.01F);
  EXPECT_LT((list.position_m(0) - moved_m).norm(), 2.0F * kStep_m);
}

TEST(SampleList, NotFiniteSamples_AreFiniteAfterwards) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    List list = Started();
    EXPECT_TRUE(list.push_back({Vec3(bad, bad, bad), Vec3(bad, bad, bad), bad, bad, 1}));
    const ModelSample sample = list[0];
    EXPECT_TRUE(sample.position_m.allFinite());
    EXPECT_TRUE(sample.normal.allFinite());
    EXPECT_TRUE(std::isfinite(sample.variance_m2) && std::isfinite(sample.normal_variance));
  }
}

}  // namespace
}  // namespace disflow::testing
