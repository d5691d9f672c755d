// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "disflow/field/distance_field_fusion.h"
#include "disflow/field/distance_field_training.h"
#include "model_builder.h"

namespace disflow::testing {
namespace {

/// As Edge, but with few pools.
struct Few : profiles::Edge {
  static constexpr int kMaxNodes = 64;
  static constexpr int kMaxClusters = 4;
};

template <class Limits = profiles::Edge>
class Model {
 public:
  using Field = DistanceField<Limits>;
  using Fusion = typename Field::Fusion;

  explicit Model(const FieldConfig& config = {}) : field(std::make_unique<Field>()) {
    field->Start(config);
  }

  Fusion Insert(const Vec3& position_m, const Vec3& normal = Vec3::UnitZ(), float std_m = 2e-4F) {
    SurfaceSample sample;
    sample.position_m = position_m;
    sample.normal = normal;
    sample.variance_m2 = sample.fused_variance_m2 = std_m * std_m;
    sample.normal_variance = 1e-3F;
    return field->Insert(sample, frame, counters);
  }

  [[nodiscard]] std::vector<ModelSample> Samples() const {
    std::vector<ModelSample> samples;
    field->store().ForEach([&](Handle, const auto& cluster) {
      samples.insert(samples.end(), cluster.samples.begin(), cluster.samples.end());
    });
    return samples;
  }

  std::unique_ptr<Field> field;
  Counters counters;
  std::uint32_t frame = 1;
};
using Fusion = DistanceField<profiles::Edge>::Fusion;

const Vec3 kPlace_m(0.004F, 0.005F, 0.006F);
/// Of positions in the model: half a 16383rd of a cell.
constexpr float kRounding_m = 0.51F * 0.02F / 16383.0F;

TEST(DistanceField, ManyNoisyObservations_AverageToTheTruth) {
  FieldConfig config;
  config.freeze_after = 250;
  Model model(config);
  std::mt19937 random(1);
  std::normal_distribution<float> gaussian;
  constexpr int kCount = 100;
  constexpr float kNoise_m = 5e-4F;
  for (int i = 0; i < kCount; ++i)
    (void)model.Insert(kPlace_m + Vec3(0.0F, 0.0F, kNoise_m * gaussian(random)), Vec3::UnitZ(),
                       kNoise_m);
  const auto samples = model.Samples();
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0].observations, kCount);
  // The error of the mean is a tenth of one observation's; so says the sample's variance.
  EXPECT_NEAR(samples[0].position_m.z(), kPlace_m.z(),
              3.5F * kNoise_m / std::sqrt(static_cast<float>(kCount)));
  EXPECT_NEAR(std::sqrt(samples[0].variance_m2), kNoise_m / std::sqrt(static_cast<float>(kCount)),
              0.05F * kNoise_m);
}

TEST(DistanceField, Merging_MovesASampleAlongItsNormalOnly) {
  Model model;
  EXPECT_EQ(model.Insert(kPlace_m), Fusion::kAdded);
  EXPECT_EQ(model.Insert(kPlace_m + Vec3(0.002F, -0.001F, 0.0004F)), Fusion::kMerged);
  const auto samples = model.Samples();
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_NEAR(samples[0].position_m.x(), kPlace_m.x(), kRounding_m);
  EXPECT_NEAR(samples[0].position_m.y(), kPlace_m.y(), kRounding_m);
  EXPECT_GT(samples[0].position_m.z(), kPlace_m.z() + 1e-4F);
  EXPECT_LT(samples[0].position_m.z(), kPlace_m.z() + 3e-4F);
}

TEST(DistanceField, FrozenSample_DoesNotMove) {
  FieldConfig config;
  config.freeze_after = 3;
  Model model(config);
  for (int i = 0; i < 3; ++i) (void)model.Insert(kPlace_m);
  const Vec3 before_m = model.Samples()[0].position_m;
  EXPECT_EQ(model.Insert(kPlace_m + Vec3(0.0F, 0.0F, 0.001F)), Fusion::kFrozen);
  EXPECT_EQ(model.Samples()[0].position_m, before_m);
}

TEST(DistanceField, ObservationFarFromKnownSurface_IsRejectedAndCounted) {
  Model model;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int i = 0; i < 4; ++i)
        (void)model.Insert(
            Vec3(0.006F * static_cast<float>(x), 0.006F * static_cast<float>(y), 0.005F));
    }
  }
  (void)model.field->Retrain(100, model.counters);
  const std::size_t before = model.Samples().size();
  EXPECT_EQ(model.counters.observations_rejected, 0U);
  EXPECT_EQ(model.Insert(Vec3(0.001F, 0.001F, 0.012F)), Fusion::kRejected);
  EXPECT_EQ(model.counters.observations_rejected, 1U);
  EXPECT_EQ(model.Samples().size(), before);
  // The opposite side of a thin wall is another surface.
  EXPECT_EQ(model.Insert(Vec3(0.001F, 0.001F, -0.002F), -Vec3::UnitZ()), Fusion::kAdded);
}

TEST(DistanceField, ObservationOutsideOfTheMap_IsRefusedAndCounted) {
  Model model;
  const float half_m = 0.5F * model.field->config().cell_size_m * 64.0F;
  EXPECT_EQ(model.Insert(Vec3(half_m * 1.01F, 0.0F, 0.0F)), Fusion::kRefused);
  EXPECT_EQ(model.Insert(Vec3(0.0F, -half_m * 1.01F, 0.0F)), Fusion::kRefused);
  EXPECT_EQ(model.counters.observations_out_of_bounds, 2U);
  EXPECT_TRUE(model.field->empty());
}

TEST(DistanceField, SurfaceThatIsLookedThrough_IsForgottenSoonerIfItWasNeverSeen) {
  const auto frames_until_forgotten = [](int frames_seen) {
    Model model;
    EXPECT_EQ(model.Insert(kPlace_m), Fusion::kAdded);
    Handle handle = kNoHandle;
    model.field->store().ForEach([&](Handle found, const auto&) { handle = found; });
    for (int i = 0; i < frames_seen; ++i) EXPECT_FALSE(model.field->Witness(handle, true));
    int frames = 1;
    while (!model.field->Witness(handle, false)) ++frames;
    model.field->Forget(handle, model.counters);
    EXPECT_TRUE(model.Samples().empty());
    EXPECT_EQ(model.counters.clusters_forgotten, 1U);
    EXPECT_EQ(model.counters.clusters_evicted, 0U) << "room was not wanting";
    return frames;
  };
  const int unseen = frames_until_forgotten(0);
  EXPECT_GE(unseen, 3) << "a pose that is off for a moment must not cost surface";
  EXPECT_GT(frames_until_forgotten(3), unseen);
  // However long it was seen, it can be forgotten within a second.
  EXPECT_EQ(frames_until_forgotten(1000), frames_until_forgotten(100));
  EXPECT_LE(frames_until_forgotten(1000), 30);
}

TEST(DistanceField, SurfaceSeenInPassing_IsUnconfirmedUnlessItWasObservedThreeTimes) {
  for (const int observations : {1, 2, 3, 4}) {
    Model model;
    for (int i = 0; i < observations; ++i) {
      ++model.frame;
      (void)model.Insert(kPlace_m);
    }
    // Observed once each in many places it is as little confirmed.
    (void)model.Insert(kPlace_m + Vec3(0.006F, 0.0F, 0.0F));
    const auto unconfirmed = [&](std::uint32_t frames_later) {
      int count = 0;
      model.field->ForEachUnconfirmed(model.frame + frames_later, [&](Handle) { ++count; });
      return count;
    };
    const int expected = observations < 3 ? 1 : 0;
    EXPECT_EQ(unconfirmed(0), 0) << observations;
    EXPECT_EQ(unconfirmed(7), 0) << "it may be looked at again";
    EXPECT_EQ(unconfirmed(15), expected) << observations;
    EXPECT_EQ(unconfirmed(1000), expected) << observations;
  }
}

TEST(DistanceField, KnownSurfaceMayBeRefined_WhereNoneMayBeAdded) {
  Model model;
  SurfaceSample sample;
  sample.position_m = kPlace_m;
  sample.normal = Vec3::UnitZ();
  sample.variance_m2 = sample.fused_variance_m2 = 4e-8F;
  sample.normal_variance = 1e-3F;
  EXPECT_EQ(model.field->Insert(sample, 1, model.counters), Fusion::kAdded);
  EXPECT_EQ(model.field->Insert(sample, 2, model.counters, false), Fusion::kMerged);
  sample.position_m.x() += 0.01F;
  EXPECT_EQ(model.field->Insert(sample, 2, model.counters, false), Fusion::kRejected);
  EXPECT_EQ(model.counters.observations_rejected, 1U);
  EXPECT_EQ(model.field->Insert(sample, 2, model.counters), Fusion::kAdded);
}

TEST(DistanceField, PoolFull_TheStalestClusterMakesRoom) {
  Model<Few> model;
  const auto place_m = [](int i) {
    return Vec3(0.005F + 0.02F * static_cast<float>(i), 0.005F, 0.005F);
  };
  for (int i = 0; i < Few::kMaxClusters; ++i) {
    model.frame = static_cast<std::uint32_t>(10 + i);
    ASSERT_EQ(model.Insert(place_m(i)), Model<Few>::Fusion::kAdded);
  }
  // The first is seen again, so the second is the stalest.
  model.frame = 20;
  (void)model.Insert(place_m(0));
  EXPECT_EQ(model.counters.clusters_evicted, 0U);
  model.frame = 21;
  EXPECT_EQ(model.Insert(place_m(-1)), Model<Few>::Fusion::kAdded);
  EXPECT_EQ(model.counters.clusters_evicted, 1U);
  EXPECT_EQ(model.field->store().size(), Few::kMaxClusters);
  const auto knows = [&](int i) {
    for (const ModelSample& sample : model.Samples()) {
      if ((sample.position_m - place_m(i)).norm() < 1e-3F) return true;
    }
    return false;
  };
  EXPECT_TRUE(knows(-1));
  EXPECT_TRUE(knows(0));
  EXPECT_FALSE(knows(1));
  EXPECT_TRUE(knows(2));
}

TEST(DistanceField, PoolFullWithinOneFrame_RefusesInsteadOfForgetting) {
  Model<Few> model;
  for (int i = 0; i < 2 * Few::kMaxClusters; ++i)
    (void)model.Insert(Vec3(0.005F + 0.02F * static_cast<float>(i), 0.0F, 0.0F));
  EXPECT_EQ(model.field->store().size(), Few::kMaxClusters);
  EXPECT_EQ(model.counters.clusters_evicted, 0U);
  EXPECT_EQ(model.counters.samples_refused, static_cast<std::uint32_t>(Few::kMaxClusters));
}

TEST(DistanceField, UnusableObservation_ChangesNothing) {
  Model model;
  for (int i = 0; i < 4; ++i) (void)model.Insert(kPlace_m);
  (void)model.field->Retrain(10, model.counters);
  const Vec3 before_m = model.Samples()[0].position_m;
  std::uint32_t refused = 0;
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 position_m = kPlace_m;
      position_m(axis) = bad;
      EXPECT_EQ(model.Insert(position_m), Fusion::kRejected);
      Vec3 normal = Vec3::UnitZ();
      normal(axis) = bad;
      EXPECT_EQ(model.Insert(kPlace_m, normal), Fusion::kRejected);
      refused += 2;
    }
    EXPECT_EQ(model.Insert(kPlace_m, Vec3::UnitZ(), bad), Fusion::kRejected);
    ++refused;
  }
  EXPECT_EQ(model.Insert(kPlace_m, Vec3::Zero()), Fusion::kRejected);
  EXPECT_EQ(model.counters.observations_rejected, refused + 1);
  ASSERT_EQ(model.Samples().size(), 1U);
  EXPECT_EQ(model.Samples()[0].position_m, before_m);
  EXPECT_EQ(model.field->store().size(), 1);
}

TEST(DistanceField, Retraining_KeepsToItsBudget) {
  auto field = std::make_unique<EdgeField>();
  field->Start({});
  Counters counters;
  std::mt19937 random(1);
  const Shape sphere = OddSphere();
  for (int i = 0; i < 4000; ++i)
    (void)field->Insert(Observe(sphere.random_point(random), {}, random), 1, counters);
  const auto trained = [&] {
    int count = 0;
    field->store().ForEach(
        [&](Handle, const auto& cluster) { count += cluster.gp.trained() ? 1 : 0; });
    return count;
  };
  const int clusters = field->store().size();
  ASSERT_GT(clusters, 20);
  EXPECT_EQ(trained(), 0);
  EXPECT_EQ(field->Retrain(4, counters), 4);
  EXPECT_EQ(trained(), 4);
  EXPECT_EQ(field->Retrain(0, counters), 0);
  EXPECT_EQ(field->Retrain(10000, counters), clusters - 4);
  EXPECT_EQ(trained(), clusters);
  EXPECT_EQ(field->Retrain(10000, counters), 0);
}

TEST(DistanceField, SidesOfACrease_AreKeptApart) {
  Model model;
  const Vec3 inside_a_cell_m(0.005F, 0.005F, 0.005F);
  (void)model.Insert(inside_a_cell_m, Vec3::UnitZ());
  (void)model.Insert(inside_a_cell_m + Vec3(0.001F, 0.0F, -0.001F), Vec3::UnitX());
  EXPECT_EQ(model.field->store().size(), 2);
  EXPECT_EQ(model.Samples().size(), 2U);
}

TEST(DistanceField, Bounds_EncloseAllSamples) {
  const auto field = MakeModel(OddBox());
  field->store().ForEach([&](Handle, const auto& cluster) {
    for (const ModelSample& sample : cluster.samples) {
      EXPECT_GE((sample.position_m - field->bounds_min_m()).minCoeff(), -1e-3F);
      EXPECT_GE((field->bounds_max_m() - sample.position_m).minCoeff(), -1e-3F);
    }
  });
}

TEST(DistanceField, MoreCandidatesThanAGpConsiders_AreCounted) {
  FieldConfig config;
  config.merge_radius_m = 0.001F;
  config.overlap_m = 0.02F;
  Model model(config);
  // A dense plane: far more samples within reach of a cell than a GP is trained on.
  for (int x = -20; x < 20; ++x) {
    for (int y = -20; y < 20; ++y)
      (void)model.Insert(
          Vec3(0.004F * static_cast<float>(x), 0.004F * static_cast<float>(y), 0.005F));
  }
  EXPECT_EQ(model.counters.candidates_dropped, 0U);
  (void)model.field->Retrain(1, model.counters);
  EXPECT_GT(model.counters.candidates_dropped, 0U);

  Model usual;
  for (int x = -20; x < 20; ++x) {
    for (int y = -20; y < 20; ++y)
      (void)usual.Insert(
          Vec3(0.004F * static_cast<float>(x), 0.004F * static_cast<float>(y), 0.005F));
  }
  (void)usual.field->Retrain(1000, usual.counters);
  EXPECT_EQ(usual.counters.candidates_dropped, 0U);
}

}  // namespace
}  // namespace disflow::testing
