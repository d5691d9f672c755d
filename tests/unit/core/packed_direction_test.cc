// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/packed_direction.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <random>

namespace disflow::testing {
namespace {

static_assert(sizeof(PackedDirection) == 4);

constexpr float kError_rad = 7e-5F;

Vec3 RoundTrip(const Vec3& direction) { return PackedDirection(direction).direction(); }

void ExpectKept(const Vec3& direction) {
  const Vec3 packed = RoundTrip(direction);
  EXPECT_LT((packed - direction).norm(), kError_rad) << direction.transpose();
  EXPECT_NEAR(packed.norm(), 1.0F, 5e-7F);
}

TEST(PackedDirection, RoundTrip_IsCloseEverywhere) {
  std::mt19937 random(1);
  std::normal_distribution<float> gaussian;
  for (int i = 0; i < 100000; ++i)
    ExpectKept(Vec3(gaussian(random), gaussian(random), gaussian(random)).normalized());
}

TEST(PackedDirection, AxesDiagonalsAndTheirSurroundings_AreKept) {
  std::mt19937 random(2);
  std::normal_distribution<float> gaussian;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3 direction =
            Vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)).normalized();
        ExpectKept(direction);
        for (int i = 0; i < 100; ++i) {
          const Vec3 shake(gaussian(random), gaussian(random), gaussian(random));
          ExpectKept((direction + 1e-4F * shake).normalized());
        }
      }
    }
  }
  ExpectKept(Vec3(-0.0F, 0.0F, -1.0F));
}

TEST(PackedDirection, Length_DoesNotMatter) {
  const Vec3 direction(0.3F, -0.5F, 0.2F);
  EXPECT_EQ(RoundTrip(direction), RoundTrip(1024.0F * direction));
}

TEST(PackedDirection, WhatIsNoDirection_BecomesSomeDirection) {
  using Limits = std::numeric_limits<float>;
  for (const float bad : {Limits::quiet_NaN(), Limits::infinity(), 0.0F, Limits::denorm_min()}) {
    for (const Vec3& direction : {Vec3(bad, bad, bad), Vec3(bad, 0.0F, 0.0F), Vec3(0.0F, bad, -bad),
                                  Vec3(0.0F, 0.0F, -bad)}) {
      const Vec3 packed = RoundTrip(direction);
      EXPECT_TRUE(packed.allFinite());
      EXPECT_NEAR(packed.norm(), 1.0F, 5e-7F);
    }
  }
}

}  // namespace
}  // namespace disflow::testing
