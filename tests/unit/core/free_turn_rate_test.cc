// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "disflow/flow/twist_filter.h"
#include "disflow/geometry/covariance.h"

namespace disflow {
namespace {

constexpr float kTimeConstant_s = 0.5F;
constexpr float kTurnRate_rps = 5.0F;
const Vec3 kVelocity_mps(0.1F, -0.3F, 0.2F);

/// A can that stands along the camera's axis, glides, and turns about its own at a rate that grows.
class TurningCan {
 public:
  explicit TurningCan(const Vec3& origin_o_m, float angular_acceleration_rps2)
      : origin_o_m_(origin_o_m), acceleration_rps2_(angular_acceleration_rps2) {
    filter_.Start(TwistFilterConfig{}, stamp_ns_, T_co(0.0F), PoseCovariance());
    constexpr int kFrames = 45;
    constexpr StampNs kFrame_ns = 33'000'000;
    for (int i = 1; i <= kFrames; ++i) {
      Coast(kFrame_ns);
      filter_.Update(T_co(Seconds(i * kFrame_ns)), PoseCovariance());
    }
  }
  void Coast(StampNs step_ns) {
    stamp_ns_ += step_ns;
    filter_.Predict(stamp_ns_);
  }
  void Fade(float time_constant_s) { filter_.FadeTurn(FreeTurn(), time_constant_s); }

  [[nodiscard]] Twist twist() const { return filter_.twist(); }
  [[nodiscard]] const TwistFilter& filter() const { return filter_; }

 private:
  static Mat6 PoseCovariance() {
    Vec6 variance;
    variance << Vec3::Constant(1e-8F), Vec3::Constant(1e-7F);
    return variance.asDiagonal();
  }
  [[nodiscard]] PoseCameraFromObject T_co(float t_s) const {
    const float angle_rad = kTurnRate_rps * t_s + 0.5F * acceleration_rps2_ * t_s * t_s;
    const Mat3 rotation = ExpSo3(Vec3(angle_rad * Vec3::UnitZ()));
    return {rotation, Vec3(Vec3::UnitZ() + t_s * kVelocity_mps + rotation * origin_o_m_)};
  }
  /// A turn about the can's axis, of its origin.
  [[nodiscard]] Mat6 FreeTurn() const {
    constexpr float kAnyTurnRate_rps = 3.0F;
    Mat6 about_axis = Mat6::Zero();
    about_axis(5, 5) = kAnyTurnRate_rps * kAnyTurnRate_rps;
    return CovarianceAtPoint(about_axis, Mat3::Identity(),
                             Vec3(filter_.T_co().rotation() * origin_o_m_));
  }

  Vec3 origin_o_m_;
  float acceleration_rps2_;
  StampNs stamp_ns_ = 1'000'000'000'000;
  TwistFilter filter_;
};

TEST(FreeTurnRate, InATimeConstant_FallsToItsEthPartInHoweverManySteps) {
  for (const int steps : {1, 2, 15}) {
    TurningCan can(Vec3::Zero(), 0.0F);
    ASSERT_NEAR(can.twist().angular_rps.z(), kTurnRate_rps, 0.01F * kTurnRate_rps);
    for (int i = 0; i < steps; ++i) {
      can.Coast(500'000'000 / steps);
      can.Fade(kTimeConstant_s);
    }
    // Of what fades a hundredth is always left.
    EXPECT_NEAR(can.twist().angular_rps.z() / kTurnRate_rps, std::exp(-1.0F), 0.015F) << steps;
  }
}

TEST(FreeTurnRate, ThatFades_TakesNothingOfOtherMotion) {
  TurningCan can(Vec3::Zero(), 0.0F);
  const Twist before = can.twist();
  can.Coast(100'000'000);
  const Mat6 covariance = can.filter().twist_covariance();
  can.Fade(kTimeConstant_s);
  EXPECT_LT((can.twist().linear_mps - before.linear_mps).norm(), 1e-3F);
  EXPECT_LT((can.twist().angular_rps - before.angular_rps).head<2>().norm(), 1e-3F);
  EXPECT_EQ(can.filter().twist_covariance(), covariance);
}

TEST(FreeTurnRate, OfAnOriginBesideTheAxis_FadesWithTheWayThatComesOfIt) {
  TurningCan can(Vec3(0.05F, 0.0F, 0.0F), 0.0F);
  ASSERT_GT((can.twist().linear_mps - kVelocity_mps).norm(), 0.2F);
  can.Fade(1e-3F);
  EXPECT_LT((can.twist().linear_mps - kVelocity_mps).norm(), 0.05F);
  EXPECT_LT(can.twist().angular_rps.norm(), 0.1F * kTurnRate_rps);
}

TEST(FreeTurnRate, ThatGrew_GrowsNoMore) {
  TurningCan growing(Vec3::Zero(), 6.0F);
  TurningCan faded = growing;
  faded.Fade(1e6F);  // Of the rate nothing is taken.
  const float rate_rps = growing.twist().angular_rps.z();
  ASSERT_NEAR(faded.twist().angular_rps.z(), rate_rps, 1e-3F);
  growing.Coast(100'000'000);
  faded.Coast(100'000'000);
  EXPECT_GT(growing.twist().angular_rps.z(), rate_rps + 0.4F);
  EXPECT_NEAR(faded.twist().angular_rps.z(), rate_rps, 0.05F);
}

TEST(FreeTurnRate, WithoutAFreeTurn_Stays) {
  TurningCan can(Vec3::Zero(), 6.0F);
  TwistFilter filter = can.filter();
  filter.FadeTurn(Mat6::Zero(), kTimeConstant_s);
  EXPECT_EQ(filter.twist().linear_mps, can.twist().linear_mps);
  EXPECT_EQ(filter.twist().angular_rps, can.twist().angular_rps);
  filter.Predict(filter.stamp_ns() + 100'000'000);
  can.Coast(100'000'000);
  EXPECT_EQ(filter.twist().angular_rps, can.twist().angular_rps);
}

}  // namespace
}  // namespace disflow
