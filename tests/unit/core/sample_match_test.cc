// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/sample_match.h"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "disflow/flow/registration_impl.h"
#include "model_builder.h"

namespace disflow::testing {
namespace {

using WideRegistration = Registration<profiles::Edge>;

/// A wall that faces the camera, as pixels of some width show it.
class WallOfWidePixels {
 public:
  static constexpr float kDepth_m = 0.9F;
  static constexpr int kAcross = 8;

  explicit WallOfWidePixels(float pitch_m) : pitch_m_(pitch_m) {}

  /// @param shift How far the pixels lie beside where they were, in their width.
  [[nodiscard]] WideRegistration::Samples Seen(float shift) const {
    WideRegistration::Samples samples;
    for (int row = 0; row < kAcross; ++row) {
      for (int column = 0; column < kAcross; ++column) {
        SurfaceSample sample;
        sample.position_m =
            Vec3(pitch_m_ * (static_cast<float>(column - kAcross / 2) + shift),
                 pitch_m_ * (static_cast<float>(row - kAcross / 2) + shift), kDepth_m);
        sample.normal = -Vec3::UnitZ();
        sample.variance_m2 = sample.fused_variance_m2 = 1e-6F;
        sample.normal_variance = 1e-4F;
        sample.reach_m = pitch_m_ * std::numbers::sqrt2_v<float> / 2.0F;
        (void)samples.push_back(sample);
      }
    }
    return samples;
  }
  /// The object frame's origin lies on the wall.
  [[nodiscard]] static PoseObjectFromCamera T_oc() {
    return {Mat3(Mat3::Identity()), Vec3(0.0F, 0.0F, -kDepth_m)};
  }
  /// What is learnt of one image.
  [[nodiscard]] std::unique_ptr<EdgeField> Model() const {
    auto field = std::make_unique<EdgeField>();
    field->Start({});
    Counters counters;
    for (SurfaceSample sample : Seen(0.0F)) {
      sample.position_m = T_oc() * sample.position_m;
      (void)field->Insert(sample, 1, counters);
    }
    (void)field->Retrain(1000, counters);
    return field;
  }

 private:
  float pitch_m_;
};

class SampleMatch : public ::testing::TestWithParam<float> {};

TEST_P(SampleMatch, NearlyHalfABlockBesideTheModels_IsFoundHoweverWideThePixels) {
  const WallOfWidePixels wall(GetParam());
  const auto model = wall.Model();
  const RegistrationConfig config;
  // The last row and column lie beyond what was seen by as much.
  for (const SurfaceSample& sample : wall.Seen(0.45F))
    EXPECT_TRUE(MatchOf(*model, config, wall.T_oc(), sample).found)
        << sample.position_m.transpose();
}

TEST_P(SampleMatch, FartherThanItsBlockReaches_IsNotFound) {
  const WallOfWidePixels wall(GetParam());
  const auto model = wall.Model();
  const SurfaceSample outermost = wall.Seen(2.0F).back();
  EXPECT_FALSE(MatchOf(*model, RegistrationConfig{}, wall.T_oc(), outermost).found);
}

TEST_P(SampleMatch, NarrowKernelsOfTheLastSteps_LoseNoSample) {
  const WallOfWidePixels wall(GetParam());
  const auto model = wall.Model();
  const auto registration = std::make_unique<WideRegistration>();
  const WideRegistration::Edges no_edges;
  WideRegistration::Model no_model_edges;
  no_model_edges.Start();
  registration->SetObservations(wall.Seen(0.45F), no_edges);
  constexpr float kNarrow_m = 1e-4F;
  const auto result = registration->Align(*model, no_model_edges, RegistrationConfig{}, wall.T_oc(),
                                          wall.T_oc(), {kNarrow_m, kNarrow_m}, {8});
  EXPECT_TRUE(result.solved);
  EXPECT_EQ(result.unmatched, 0);
  EXPECT_GT(registration->Score(*model, RegistrationConfig{}, result.T_oc), 0.9F);
}

// Of less than a cell (20 mm) the nearest cluster, chosen by its centroid, may have a farther
// sample than its neighbour.
INSTANTIATE_TEST_SUITE_P(Pitch_m, SampleMatch, ::testing::Values(0.02F, 0.03F, 0.05F));

}  // namespace
}  // namespace disflow::testing
