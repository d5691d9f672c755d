// SPDX-License-Identifier: BSD-3-Clause
#include "consistency.h"

#include <gtest/gtest.h>

#include <random>

#include "run_builder.h"

namespace disflow::apps {
namespace {

constexpr double kPositionStd_m = 0.002;
constexpr double kRotationStd_rad = 0.01;

Mat6d Diagonal(double first_std, double second_std) {
  Vec6d variances;
  variances << Vec3d::Constant(first_std * first_std), Vec3d::Constant(second_std * second_std);
  return variances.asDiagonal();
}

/// Spoils every row but the first with Gaussian noise of the covariance that the row states.
void AddNoise(MadeUpRun& made, double stated_over_true) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  const auto draw = [&](double std) {
    return Vec3d(std * normal(generator), std * normal(generator), std * normal(generator));
  };
  const double s = stated_over_true;
  for (std::size_t k = 0; k < made.estimates.rows.size(); ++k) {
    EstimateRow& row = made.estimates.rows[k];
    row.pose_covariance = Diagonal(s * kPositionStd_m, s * kRotationStd_rad);
    row.twist_covariance = Diagonal(s * 0.02, s * 0.1);
    if (k == 0) continue;
    row.T_co = EstimatedPose(Mat3d(ExpSo3(draw(kRotationStd_rad)) * row.T_co.rotation()),
                             Vec3d(row.T_co.translation() + draw(kPositionStd_m)));
    row.twist.linear_mps += draw(0.02);
    row.twist.angular_rps += draw(0.1);
  }
}

TEST(ChiSquareTest, Bounds_AreTheQuantilesThatTheirNamesSay) {
  EXPECT_NEAR(ChiSquare6Cdf(kChiSquare6At2_5), 0.025, 1e-12);
  EXPECT_NEAR(ChiSquare6Cdf(kChiSquare6At95), 0.95, 1e-12);
  EXPECT_NEAR(ChiSquare6Cdf(kChiSquare6At97_5), 0.975, 1e-12);
  EXPECT_DOUBLE_EQ(ChiSquare6Cdf(0.0), 0.0);
}

TEST(ConsistencyTest, KnownError_GivesKnownNees) {
  MadeUpRun made = MakeRun(2);
  EstimateRow& row = made.estimates.rows[1];
  row.pose_covariance = Diagonal(0.001, 0.01);
  row.T_co = EstimatedPose(Mat3d(ExpSo3(Vec3d(0.0, 0.03, 0.0)) * row.T_co.rotation()),
                           Vec3d(row.T_co.translation() + Vec3d(0.002, 0.0, 0.0)));
  const auto result = EvaluatePoseConsistency(Align(made.truth, made.estimates));
  ASSERT_TRUE(result.has_value());
  ASSERT_EQ(result->nees.size(), 1U);
  EXPECT_NEAR(result->nees[0], 4.0 + 9.0, 1e-6);
}

TEST(ConsistencyTest, TruthfulCovariance_IsConsistentWhereverTheTrackersOriginLies) {
  MadeUpRun made = MakeRun(3000);
  AddNoise(made, 1.0);
  const AlignedTrajectory run = Align(made.truth, made.estimates);
  for (const auto& result : {EvaluatePoseConsistency(run), EvaluateTwistConsistency(run)}) {
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->nees.size(), 2999U);
    // Standard error of the mean of 2999 chi-square(6) values: sqrt(12 / 2999) = 0.063.
    EXPECT_NEAR(result->statistics.mean, 6.0, 0.3);
    EXPECT_NEAR(result->share_inside, 0.95, 0.02);
    EXPECT_NEAR(result->share_below_95, 0.95, 0.02);
  }
}

TEST(ConsistencyTest, TruthThatIsOffAsFarAsIsSaid_DoesNotMakeATruthfulCovarianceLookTooSmall) {
  const TruthDeviation off{0.004, 0.03, 0.05, 0.2};
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  const auto draw = [&](double std) {
    return Vec3d(std * normal(generator), std * normal(generator), std * normal(generator));
  };
  // The aligned frame's error is in all frames of a run, so that the mean needs many runs.
  double pose = 0.0;
  double pose_as_if_exact = 0.0;
  double twist = 0.0;
  constexpr int kRuns = 1500;
  for (int k = 0; k < kRuns; ++k) {
    MadeUpRun made = MakeRun(2);
    made.estimates.rows[1].pose_covariance = Diagonal(kPositionStd_m, kRotationStd_rad);
    made.estimates.rows[1].twist_covariance = Diagonal(0.02, 0.1);
    EstimateRow& row = made.estimates.rows[1];
    row.T_co = EstimatedPose(Mat3d(ExpSo3(draw(kRotationStd_rad)) * row.T_co.rotation()),
                             Vec3d(row.T_co.translation() + draw(kPositionStd_m)));
    row.twist.linear_mps += draw(0.02);
    row.twist.angular_rps += draw(0.1);
    for (std::size_t i = 0; i < 2; ++i) {
      TruePose& T_ct = made.truth.T_ct[i];
      T_ct = TruePose(Mat3d(ExpSo3(draw(off.rotation_rad)) * T_ct.rotation()),
                      Vec3d(T_ct.translation() + draw(off.position_m)));
      made.truth.twists[i].linear_mps += draw(off.linear_mps);
      made.truth.twists[i].angular_rps += draw(off.angular_rps);
    }
    const AlignedTrajectory run = Align(made.truth, made.estimates);
    pose += EvaluatePoseConsistency(run, off)->nees.at(0) / kRuns;
    pose_as_if_exact += EvaluatePoseConsistency(run)->nees.at(0) / kRuns;
    twist += EvaluateTwistConsistency(run, off)->nees.at(0) / kRuns;
  }
  // Standard error of the mean of 1500 chi-square(6) values: sqrt(12 / 1500) = 0.09.
  EXPECT_NEAR(pose, 6.0, 0.4);
  EXPECT_NEAR(twist, 6.0, 0.4);
  EXPECT_GT(pose_as_if_exact, 40.0);
}

TEST(ConsistencyTest, TruthThatIsOff_DoesNotMakeACovarianceOfWhatIsNone) {
  MadeUpRun made = MakeRun(2);
  made.estimates.rows[1].pose_covariance = -Mat6d::Identity();
  const auto result =
      EvaluatePoseConsistency(Align(made.truth, made.estimates), TruthDeviation{10.0, 10.0, 0, 0});
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->singular, 1U);
}

TEST(ConsistencyTest, TooSmallCovariance_ShowsAsOverconfident) {
  MadeUpRun made = MakeRun(500);
  AddNoise(made, 0.5);
  const auto result = EvaluatePoseConsistency(Align(made.truth, made.estimates));
  ASSERT_TRUE(result.has_value());
  EXPECT_NEAR(result->statistics.mean, 24.0, 2.0);
  EXPECT_LT(result->share_below_95, 0.3);
}

TEST(ConsistencyTest, TooLargeCovariance_IsBelowTheBoundButNotInside) {
  MadeUpRun made = MakeRun(500);
  AddNoise(made, 5.0);
  const auto result = EvaluatePoseConsistency(Align(made.truth, made.estimates));
  ASSERT_TRUE(result.has_value());
  EXPECT_DOUBLE_EQ(result->share_below_95, 1.0);
  EXPECT_LT(result->share_inside, 0.05);
}

TEST(ConsistencyTest, CovarianceThatIsNotPositiveDefinite_CountsAsOutside) {
  MadeUpRun made = MakeRun(3);
  made.estimates.rows[1].pose_covariance = Mat6d::Zero();
  made.estimates.rows[2].pose_covariance = -Mat6d::Identity();
  const auto result = EvaluatePoseConsistency(Align(made.truth, made.estimates));
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->singular, 2U);
  EXPECT_EQ(result->share_inside, 0.0);
  EXPECT_EQ(result->share_below_95, 0.0);
}

TEST(ConsistencyTest, KnownTwistError_IsWeighedAtTheTrackersOwnOrigin) {
  MadeUpRun made = MakeRun(2);
  EstimateRow& row = made.estimates.rows[1];
  row.twist_covariance = Diagonal(0.01, 0.1);
  row.twist.linear_mps += Vec3d(0.0, 0.02, 0.0);
  row.twist.angular_rps += Vec3d(0.0, 0.0, 0.3);
  const auto result = EvaluateTwistConsistency(Align(made.truth, made.estimates));
  ASSERT_TRUE(result.has_value());
  EXPECT_NEAR(result->nees[0], 4.0 + 9.0, 1e-9);
}

TEST(ConsistencyTest, ShareInside_CountsBothBounds) {
  // Errors of 1, 2 and 4 standard deviations: NEES 1, 4 and 16; only 4 is between 1.24 and 14.45.
  MadeUpRun made = MakeRun(4);
  const double sigmas[] = {0.0, 1.0, 2.0, 4.0};
  for (std::size_t k = 1; k < 4; ++k) {
    EstimateRow& row = made.estimates.rows[k];
    row.pose_covariance = Diagonal(0.001, 0.01);
    row.T_co = EstimatedPose(Mat3d(row.T_co.rotation()),
                             Vec3d(row.T_co.translation() + Vec3d(0.001 * sigmas[k], 0, 0)));
  }
  const auto result = EvaluatePoseConsistency(Align(made.truth, made.estimates));
  ASSERT_TRUE(result.has_value());
  EXPECT_NEAR(result->share_inside, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(result->share_below_95, 2.0 / 3.0, 1e-12);
  ASSERT_EQ(result->by_frame.size(), 4U);
  EXPECT_TRUE(std::isnan(result->by_frame[0])) << "the aligned frame is exact by construction";
  EXPECT_NEAR(result->by_frame[3], 16.0, 1e-6);
}

TEST(ConsistencyTest, NoCovarianceOrOnlyTheAlignedFrames_GivesNothing) {
  MadeUpRun made = MakeRun(3);
  EXPECT_FALSE(EvaluatePoseConsistency(Align(made.truth, made.estimates)).has_value());
  made.estimates.rows[0].pose_covariance = Mat6d::Identity();
  EXPECT_FALSE(EvaluatePoseConsistency(Align(made.truth, made.estimates)).has_value());
}

}  // namespace
}  // namespace disflow::apps
