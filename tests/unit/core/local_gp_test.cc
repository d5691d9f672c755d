// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <type_traits>

#include "dense_gp.h"
#include "disflow/field/gp_workspace.h"
#include "disflow/geometry/transform.h"
#include "gp_patch.h"

namespace disflow::testing {
namespace {

static_assert(std::is_trivially_destructible_v<Gp>);
static_assert(sizeof(Gp) <= 26 * kSamples + 4 * 11, "nothing but what a prediction needs");

void ExpectSameBits(const Gp& a, const Gp& b, const std::vector<Vec3>& points) {
  for (const Vec3& x_m : points) {
    EXPECT_EQ(Predict(a, x_m).distance_m, Predict(b, x_m).distance_m);
    EXPECT_EQ(Predict(a, x_m).gradient, Predict(b, x_m).gradient);
  }
}

struct Setting {
  std::string name;
  GpHyperparameters hyper;
  int count;
  /// What single precision may cost. Grows with the length scale, as samples that are close to each
  /// other tell less apart; stays within 2 % of the posterior's own standard deviation.
  double rounding_m;
};

void PrintTo(const Setting& setting, std::ostream* out) { *out << setting.name; }

/// LocalGp against the same Gaussian process, dense and in double precision.
class AgainstDenseGp : public ::testing::TestWithParam<Setting> {
 protected:
  /// Calls check(patch, gp, its workspace, dense gp) for many patches.
  template <class Check>
  void ForEachPatch(Check&& check) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      const Patch patch = RandomPatch(seed, GetParam().count);
      Gp gp;
      ASSERT_TRUE(patch.TrainInto(workspace_, gp, hyper_));
      ASSERT_TRUE(workspace_.Factorise(gp));
      check(patch, gp, DenseGp(patch.samples, patch.center_m, patch.normal, hyper_));
    }
  }

  GpHyperparameters hyper_ = GetParam().hyper;
  double rounding_m_ = GetParam().rounding_m;
  Workspace workspace_;
};

TEST_P(AgainstDenseGp, Mean_IsTheSame) {
  ForEachPatch([this](const Patch& patch, const Gp& gp, const DenseGp& dense) {
    for (const Vec3& x_m : QueryPoints(patch)) {
      const Prediction mean = Predict(gp, x_m);
      const Vec4d exact = dense.Mean(x_m.cast<double>());
      EXPECT_NEAR(static_cast<double>(mean.distance_m), exact(0), rounding_m_);
      EXPECT_LT((mean.gradient.cast<double>() - exact.tail<3>()).norm(), 3e-4);
    }
  });
}

TEST_P(AgainstDenseGp, Covariance_IsTheSame) {
  ForEachPatch([this](const Patch& patch, const Gp& gp, const DenseGp& dense) {
    for (const Vec3& x_m : QueryPoints(patch)) {
      const Mat4d covariance = workspace_.Covariance(gp, x_m).cast<double>();
      const Mat4d exact = dense.Covariance(x_m.cast<double>());
      // Each element against the standard deviations that belong to it: no unit matters.
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
          EXPECT_NEAR(covariance(i, j), exact(i, j), 5e-3 * std::sqrt(exact(i, i) * exact(j, j)))
              << i << ' ' << j;
        }
      }
    }
  });
}

TEST_P(AgainstDenseGp, SurfaceVariance_IsThatAtTheCentre) {
  ForEachPatch([](const Patch& patch, const Gp& gp, const DenseGp& dense) {
    const double exact = dense.Covariance(patch.center_m.cast<double>())(0, 0);
    EXPECT_NEAR(static_cast<double>(gp.SurfaceVariance()), exact, 5e-3 * exact);
  });
}

INSTANTIATE_TEST_SUITE_P(Settings, AgainstDenseGp,
                         ::testing::Values(Setting{"Default", kHyper, 16, 2e-6},
                                           Setting{"FewSamples", kHyper, 5, 2e-6},
                                           Setting{"OneSample", kHyper, 1, 2e-6},
                                           Setting{"ShortScale", {0.02F, 0.25F}, 16, 2e-6},
                                           Setting{"LongScale", {0.15F, 0.25F}, 16, 1e-5},
                                           Setting{"LoosePrior", {0.06F, 1.0F}, 16, 5e-6},
                                           Setting{"TightPrior", {0.06F, 0.05F}, 16, 2e-6}),
                         [](const auto& setting) { return setting.param.name; });

TEST(LocalGp, GradientOfMean_IsTheMeansDerivative) {
  Workspace workspace;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Patch patch = RandomPatch(seed);
    Gp gp;
    ASSERT_TRUE(patch.TrainInto(workspace, gp));
    constexpr float kStep_m = 5e-4F;
    for (const Vec3& x_m : QueryPoints(patch)) {
      // The kernel's third derivative jumps at a sample, where differences are worth less.
      float nearest_m = 1.0F;
      for (const auto& sample : patch.samples)
        nearest_m = std::min(nearest_m, (sample.position_m - x_m).norm());
      if (nearest_m < 4.0F * kStep_m) continue;
      const Vec3 gradient = Predict(gp, x_m).gradient;
      for (int i = 0; i < 3; ++i) {
        const Vec3 step_m = kStep_m * Vec3::Unit(i);
        const float difference_m =
            Predict(gp, x_m + step_m).distance_m - Predict(gp, x_m - step_m).distance_m;
        EXPECT_NEAR(gradient(i), difference_m / (2.0F * kStep_m), 2e-3F);
      }
    }
  }
}

TEST(LocalGp, Covariance_IsSymmetricAndPositiveSemidefinite) {
  Workspace workspace;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Patch patch = RandomPatch(seed);
    Gp gp;
    ASSERT_TRUE(patch.TrainInto(workspace, gp));
    for (const Vec3& x_m : QueryPoints(patch)) {
      const Mat4 covariance = workspace.Covariance(gp, x_m);
      EXPECT_EQ(covariance, Mat4(covariance.transpose()));
      // Scaled to unit diagonal, so that metres and slopes weigh the same.
      const Vec4 inverse_std = covariance.diagonal().cwiseSqrt().cwiseInverse();
      const Mat4 correlation = inverse_std.asDiagonal() * covariance * inverse_std.asDiagonal();
      EXPECT_GT(Eigen::LDLT<Mat4>(correlation).vectorD().minCoeff(), -1e-4F);
    }
  }
}

TEST(LocalGp, MoreSamples_NeverMakeLessCertain) {
  const Patch all = RandomPatch(4);
  Workspace workspace;
  for (const Vec3& x_m : QueryPoints(all)) {
    Mat4 before = Mat4::Constant(1e9F);
    for (std::size_t count = 1; count <= all.samples.size(); ++count) {
      Patch some = all;
      some.samples.resize(count);
      Gp gp;
      ASSERT_TRUE(some.TrainInto(workspace, gp));
      const Mat4 after = workspace.Covariance(gp, x_m);
      for (int i = 0; i < 4; ++i)
        EXPECT_LE(after(i, i), before(i, i) * (1.0F + 1e-3F)) << count << " samples, element " << i;
      before = after;
    }
  }
}

TEST(LocalGp, Variance_IsBelowTheNoiseAtASampleAndGrowsAwayFromIt) {
  const Patch patch = SpherePatch(0.1F, 0.015F);
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  for (const auto& sample : patch.samples)
    EXPECT_LT(workspace.Covariance(gp, sample.position_m)(0, 0), kValueVariance_m2);
  for (const Vec3& direction : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitZ()), Vec3(-Vec3::UnitZ()),
                                Vec3(Vec3(1.0F, -1.0F, 1.0F).normalized())}) {
    float before = 0.0F;
    for (const float away_m : {0.0F, 0.02F, 0.03F, 0.05F, 0.08F, 0.15F, 0.3F}) {
      const Vec3 x_m = patch.center_m + away_m * direction;
      const float variance = workspace.Covariance(gp, x_m)(0, 0);
      EXPECT_GT(variance, before) << away_m;
      before = variance;
    }
  }
}

TEST(LocalGp, FarAway_OnlyThePriorIsLeft) {
  const Patch patch = SpherePatch(0.1F, 0.015F);
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  const Vec3 x_m = patch.center_m + Vec3(2.0F, -1.0F, 3.0F);
  const Prediction mean = Predict(gp, x_m);
  EXPECT_NEAR(mean.distance_m, patch.normal.dot(x_m - patch.center_m), 1e-6F);
  EXPECT_LT((mean.gradient - patch.normal).norm(), 1e-6F);
  const Mat4 covariance = workspace.Covariance(gp, x_m);
  const float slope_variance = kHyper.prior_gradient_std * kHyper.prior_gradient_std;
  const float value_std_m = kHyper.prior_gradient_std * kHyper.length_scale_m / std::sqrt(3.0F);
  EXPECT_NEAR(covariance(0, 0), value_std_m * value_std_m, 1e-6F * value_std_m * value_std_m);
  for (int i = 1; i < 4; ++i) EXPECT_NEAR(covariance(i, i), slope_variance, 1e-6F);
}

TEST(LocalGp, Copy_PredictsTheSameBits) {
  const Patch patch = RandomPatch(1);
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  const Gp copy = gp;
  gp.Clear();
  EXPECT_FALSE(gp.trained());
  ASSERT_TRUE(copy.trained());
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  ExpectSameBits(gp, copy, QueryPoints(patch));
}

TEST(LocalGp, ContentOfTheWorkspace_DoesNotMatter) {
  const Patch patch = RandomPatch(2, 9);
  Workspace clean{};
  Workspace dirty;
  dirty.factor.fill(std::numeric_limits<float>::quiet_NaN());
  Gp a;
  Gp b;
  ASSERT_TRUE(patch.TrainInto(clean, a));
  ASSERT_TRUE(patch.TrainInto(dirty, b));
  ExpectSameBits(a, b, QueryPoints(patch));
  for (const Vec3& x_m : QueryPoints(patch))
    EXPECT_EQ(clean.Covariance(a, x_m), dirty.Covariance(b, x_m));
}

TEST(LocalGp, TrainedAgainOnFewer_ForgetsTheRest) {
  const Patch few = RandomPatch(2, 5);
  Workspace workspace;
  Gp fresh;
  Gp reused;
  ASSERT_TRUE(RandomPatch(8).TrainInto(workspace, reused));
  ASSERT_TRUE(few.TrainInto(workspace, reused));
  ASSERT_TRUE(few.TrainInto(workspace, fresh));
  EXPECT_EQ(reused.size(), 5);
  ExpectSameBits(fresh, reused, QueryPoints(few));
}

TEST(LocalGp, FactorisedAgain_GivesTheSameCovariance) {
  const Patch patch = RandomPatch(6);
  Workspace workspace;
  Gp gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  const Mat4 before = workspace.Covariance(gp, patch.center_m);
  Gp other;
  ASSERT_TRUE(RandomPatch(7).TrainInto(workspace, other));
  ASSERT_TRUE(workspace.Factorise(gp));
  EXPECT_EQ(workspace.Covariance(gp, patch.center_m), before);
  EXPECT_EQ(gp.SurfaceVariance(), before(0, 0));
}

TEST(LocalGp, OrderOfSamples_HardlyMatters) {
  Patch patch = RandomPatch(9);
  Workspace workspace;
  Gp original;
  ASSERT_TRUE(patch.TrainInto(workspace, original));
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(patch.samples.begin(), patch.samples.end(), random);
    Gp shuffled;
    ASSERT_TRUE(patch.TrainInto(workspace, shuffled));
    for (const Vec3& x_m : QueryPoints(patch)) {
      const Prediction a = Predict(original, x_m);
      const Prediction b = Predict(shuffled, x_m);
      EXPECT_NEAR(a.distance_m, b.distance_m, 3e-6F);
      EXPECT_LT((a.gradient - b.gradient).norm(), 1e-4F);
    }
    EXPECT_NEAR(shuffled.SurfaceVariance(), original.SurfaceVariance(),
                5e-3F * original.SurfaceVariance());
  }
}

TEST(LocalGp, MovedScene_MovesThePrediction) {
  const Patch patch = RandomPatch(10);
  using Motion = Transform<World, Object>;
  const Motion motion = Motion::Exp((Vec6() << 0.2F, -0.1F, 0.3F, 1.0F, -0.5F, 0.7F).finished());
  Patch moved{{}, motion * patch.center_m, motion.rotation() * patch.normal};
  for (GpTrainingSample sample : patch.samples) {
    sample.position_m = motion * sample.position_m;
    sample.normal = motion.rotation() * sample.normal;
    moved.samples.push_back(sample);
  }
  Workspace workspace;
  Gp gp;
  Gp moved_gp;
  ASSERT_TRUE(patch.TrainInto(workspace, gp));
  ASSERT_TRUE(moved.TrainInto(workspace, moved_gp));
  for (const Vec3& x_m : QueryPoints(patch)) {
    const Prediction here = Predict(gp, x_m);
    const Prediction there = Predict(moved_gp, motion * x_m);
    EXPECT_NEAR(here.distance_m, there.distance_m, 1e-5F);
    EXPECT_LT((motion.rotation() * here.gradient - there.gradient).norm(), 5e-4F);
  }
}

}  // namespace
}  // namespace disflow::testing
