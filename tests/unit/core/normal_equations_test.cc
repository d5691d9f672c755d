// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/normal_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "disflow/flow/residual_sums_impl.h"

namespace disflow::testing {
namespace {

using Mat7 = Mat<double, 7, 7>;
using Vec7 = Eigen::Matrix<double, 7, 1>;

constexpr float kPriorVariance_m2 = 9e-6F;
constexpr float kDeviation_m = 0.001F;

/// Residuals of which every second one depends on the radius, as least squares in seven unknowns.
class JointProblem {
 public:
  JointProblem() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> any(-1.0F, 1.0F);
    for (int i = 0; i < 60; ++i) {
      const Vec3 lever_m = 0.1F * Vec3(any(random), any(random), any(random));
      const Vec3 gradient = Vec3(any(random), any(random), any(random)).normalized();
      const float per_radius = i % 2 == 0 ? 0.3F * any(random) : 0.0F;
      const float residual_m = 0.002F * any(random);
      const float weight = 1e6F * (1.5F + any(random));
      sums_.Add(lever_m, gradient, residual_m, weight, per_radius);
      Vec7 j;
      j << gradient.cast<double>(), lever_m.cross(gradient).cast<double>(),
          static_cast<double>(per_radius);
      h_ += static_cast<double>(weight) * j * j.transpose();
      b_ += static_cast<double>(weight) * static_cast<double>(residual_m) * j;
    }
    equations_ += sums_;
    equations_.AddRadiusPrior(kDeviation_m, kPriorVariance_m2);
    h_(6, 6) += 1.0 / static_cast<double>(kPriorVariance_m2);
    b_(6) += static_cast<double>(kDeviation_m) / static_cast<double>(kPriorVariance_m2);
  }

  [[nodiscard]] const NormalEquations& equations() const { return equations_; }
  [[nodiscard]] Vec7 Solution() const { return -h_.ldlt().solve(b_); }
  [[nodiscard]] Mat7 Covariance() const { return h_.inverse(); }

 private:
  NormalSums sums_;
  NormalEquations equations_;
  Mat7 h_ = Mat7::Zero();
  Vec7 b_ = Vec7::Zero();
};

TEST(NormalEquations, PoseAndRadius_AreThoseOfTheJointLeastSquares) {
  const JointProblem problem;
  const Vec7 expected = problem.Solution();
  Vec6 xi;
  ASSERT_TRUE(problem.equations().WithoutRadius().Solve(0.0F, xi));
  EXPECT_LT((xi.cast<double>() - expected.head<6>()).norm(), 1e-4 * expected.head<6>().norm());
  EXPECT_NEAR(static_cast<double>(problem.equations().RadiusStep(xi)), expected(6),
              1e-4 * std::abs(expected(6)));
}

TEST(NormalEquations, InformationOnThePose_IsThatWithAnUnknownRadius) {
  const JointProblem problem;
  const Mat6 without = problem.equations().WithoutRadius().h;
  const Eigen::Matrix<double, 6, 6> covariance = without.cast<double>().inverse();
  const Mat7 expected = problem.Covariance();
  EXPECT_LT((covariance - Eigen::Matrix<double, 6, 6>(expected.topLeftCorner(6, 6))).norm(),
            1e-3 * covariance.norm());
}

TEST(NormalEquations, VarianceOfTheRadius_IsThatWithAnUnknownPose) {
  const JointProblem problem;
  const double variance_m2 =
      static_cast<double>(problem.equations().RadiusVariance(problem.equations().WithoutRadius()));
  EXPECT_NEAR(variance_m2, problem.Covariance()(6, 6), 1e-3 * variance_m2);
}

TEST(NormalEquations, WithoutEdges_TheRadiusStaysWhatItWas) {
  NormalSums sums;
  for (int axis = 0; axis < 3; ++axis) {
    sums.Add(Vec3::Zero(), Vec3::Unit(axis), 0.001F, 1e6F);
    sums.Add(0.1F * Vec3::Unit(axis), Vec3::Unit((axis + 1) % 3), 0.001F, 1e6F);
  }
  NormalEquations equations;
  equations += sums;
  equations.AddRadiusPrior(0.0F, kPriorVariance_m2);
  const NormalEquations pose = equations.WithoutRadius();
  EXPECT_EQ(pose.h, equations.h);
  Vec6 xi;
  ASSERT_TRUE(pose.Solve(0.0F, xi));
  EXPECT_EQ(equations.RadiusStep(xi), 0.0F);
  EXPECT_FLOAT_EQ(equations.RadiusVariance(pose), kPriorVariance_m2);
}

}  // namespace
}  // namespace disflow::testing
