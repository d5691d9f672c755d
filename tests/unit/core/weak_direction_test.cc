// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/weak_direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "disflow/geometry/transform.h"

namespace disflow {
namespace {

const MonitorConfig kConfig{};

Mat3 Turn() { return ExpSo3(Vec3(0.4F, -0.9F, 0.3F)); }

/// A covariance with these standard deviations along (and about) turned axes.
Mat6 Covariance(const Vec3& std_m, const Vec3& std_rad) {
  Mat6 covariance = Mat6::Zero();
  const Mat3 turn = Turn();
  covariance.topLeftCorner<3, 3>() = turn * Vec3(std_m.cwiseAbs2()).asDiagonal() * turn.transpose();
  covariance.bottomRightCorner<3, 3>() =
      turn * Vec3(std_rad.cwiseAbs2()).asDiagonal() * turn.transpose();
  return covariance;
}

TEST(WeakDirection, AllWithinBounds_IsNone) {
  const Vec3 std_m = Vec3::Constant(0.99F * kConfig.weak_std_m);
  const Vec3 std_rad = Vec3::Constant(0.99F * kConfig.weak_std_rad);
  const WeakDirection weak = FindWeakDirection(Covariance(std_m, std_rad), kConfig);
  EXPECT_EQ(weak.kind, WeakKind::kNone);
  EXPECT_EQ(weak.axis.norm(), 0.0F);
  EXPECT_EQ(weak.std, 0.0F);
}

TEST(WeakDirection, RotationAboutAnAxis_IsNamed) {
  for (int i = 0; i < 3; ++i) {
    Vec3 std_rad(0.003F, 0.004F, 0.002F);
    std_rad[i] = 0.05F;
    const WeakDirection weak =
        FindWeakDirection(Covariance(Vec3::Constant(0.001F), std_rad), kConfig);
    EXPECT_EQ(weak.kind, WeakKind::kRotation);
    EXPECT_NEAR(std::abs(weak.axis.dot(Turn().col(i))), 1.0F, 1e-4F);
    EXPECT_NEAR(weak.axis.norm(), 1.0F, 1e-4F);
    EXPECT_NEAR(weak.std, 0.05F, 1e-4F);
  }
}

TEST(WeakDirection, TranslationAlongAnAxis_IsNamed) {
  const WeakDirection weak =
      FindWeakDirection(Covariance(Vec3(0.001F, 0.02F, 0.002F), Vec3::Constant(0.005F)), kConfig);
  EXPECT_EQ(weak.kind, WeakKind::kTranslation);
  EXPECT_NEAR(std::abs(weak.axis.dot(Turn().col(1))), 1.0F, 1e-4F);
  EXPECT_NEAR(weak.std, 0.02F, 1e-4F);
}

TEST(WeakDirection, OfTwo_TheOneFartherBeyondItsBoundIsNamed) {
  const auto find = [](float times_m, float times_rad) {
    return FindWeakDirection(Covariance(Vec3(times_m * kConfig.weak_std_m, 0.001F, 0.001F),
                                        Vec3(0.001F, times_rad * kConfig.weak_std_rad, 0.001F)),
                             kConfig)
        .kind;
  };
  EXPECT_EQ(find(2.0F, 3.0F), WeakKind::kRotation);
  EXPECT_EQ(find(3.0F, 2.0F), WeakKind::kTranslation);
}

TEST(WeakDirection, WhatIsNotFinite_IsNotNamed) {
  Mat6 covariance = Covariance(Vec3::Constant(0.1F), Vec3::Constant(0.1F));
  covariance(4, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(FindWeakDirection(covariance, kConfig).kind, WeakKind::kNone);
}

TEST(WeakDirection, EveryKind_HasAName) {
  EXPECT_STREQ(Name(WeakKind::kNone), "none");
  EXPECT_STREQ(Name(WeakKind::kTranslation), "translation");
  EXPECT_STREQ(Name(WeakKind::kRotation), "rotation");
}

}  // namespace
}  // namespace disflow
