// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/expected_turn.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace disflow::testing {
namespace {

constexpr float kStd_rad = 0.5F;

Mat3 Tumbled() { return ExpSo3(Vec3(0.4F, -1.2F, 2.0F)); }
ExpectedTurn ExpectedAs(float std_rad) {
  return {Tumbled(), Mat3(std_rad * std_rad * Mat3::Identity())};
}

TEST(ExpectedTurn, AsPredicted_IsTheLikeliest) {
  EXPECT_NEAR(ExpectedAs(kStd_rad).Unlikelihood(Tumbled()), 0.0F, 1e-6F);
}

TEST(ExpectedTurn, OneDeviationOff_IsHalfANatLessLikelyAboutAnyAxis) {
  for (const Vec3& axis : {Vec3(1.0F, 0.0F, 0.0F), Vec3(0.0F, 0.6F, -0.8F)}) {
    const Mat3 turned = ExpSo3(Vec3(kStd_rad * axis)) * Tumbled();
    EXPECT_NEAR(ExpectedAs(kStd_rad).Unlikelihood(turned), 0.5F, 1e-4F);
  }
}

TEST(ExpectedTurn, TurnedOver_IsUnlikelyUntilTheMotionIsForgotten) {
  const Mat3 turned_over = ExpSo3(Vec3(std::numbers::pi_v<float>, 0.0F, 0.0F)) * Tumbled();
  EXPECT_GT(ExpectedAs(0.3F).Unlikelihood(turned_over), 50.0F);
  EXPECT_LT(ExpectedAs(4.0F).Unlikelihood(turned_over), 0.5F);
}

TEST(ExpectedTurn, NothingIsKnownBetterThanRegistrationIsLost) {
  const Mat3 turned = ExpSo3(Vec3(0.2F, 0.0F, 0.0F)) * Tumbled();
  EXPECT_NEAR(ExpectedAs(1e-4F).Unlikelihood(turned), 0.5F, 1e-4F);
  EXPECT_TRUE(std::isfinite(ExpectedAs(0.0F).Unlikelihood(turned)));
}

}  // namespace
}  // namespace disflow::testing
