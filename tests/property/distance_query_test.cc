// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/distance_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model_builder.h"

namespace disflow::testing {
namespace {

constexpr float kSupport_m = 0.008F;

/// A model and what is asked of it.
class Queried {
 public:
  explicit Queried(const Shape& shape, const Observing& observing = {})
      : field_(MakeModel(shape, observing)),
        workspace_(std::make_unique<GpWorkspace<profiles::Edge::kMaxTrainingSamples>>()),
        querier_(*field_, *workspace_, kSupport_m) {}

  DistanceQuery At(const Vec3& x_m) {
    const Expected<DistanceQuery> answer = querier_.Query(x_m);
    EXPECT_EQ(answer.status, Status::kOk);
    return answer.value;
  }

 private:
  std::unique_ptr<EdgeField> field_;
  std::unique_ptr<GpWorkspace<profiles::Edge::kMaxTrainingSamples>> workspace_;
  DistanceQuerier<profiles::Edge> querier_;
};

Observing Noisy() {
  Observing observing;
  observing.noise_m = 2e-4F;
  observing.normal_noise = 0.03F;
  return observing;
}

struct Case {
  const char* name;
  Shape shape;
};
const std::vector<Case>& Cases() {
  static const std::vector<Case> cases{{"sphere", OddSphere()},
                                       {"plane", OddPlane()},
                                       {"box", OddBox()},
                                       {"cylinder", OddCylinder()}};
  return cases;
}

constexpr int kProbes = 800;
constexpr std::array<float, 5> kHeights_m{0.0F, 0.002F, -0.002F, 0.005F, -0.005F};

TEST(DistanceQuery, CleanObservations_DistanceIsTrueNearTheSurface) {
  for (const Case& tested : Cases()) {
    Queried model(tested.shape);
    std::mt19937 random(3);
    for (const float height_m : kHeights_m) {
      double sum_squared_m2 = 0.0;
      float worst_m = 0.0F;
      for (int i = 0; i < kProbes; ++i) {
        const SurfacePoint point = tested.shape.random_point(random);
        const Vec3 x_m = point.position_m + height_m * point.normal;
        const float error_m = model.At(x_m).distance_m - tested.shape.distance_m(x_m);
        sum_squared_m2 += static_cast<double>(error_m * error_m);
        worst_m = std::max(worst_m, std::abs(error_m));
      }
      EXPECT_LT(std::sqrt(sum_squared_m2 / kProbes), 3e-4) << tested.name << " at " << height_m;
      EXPECT_LT(worst_m, 6e-4F) << tested.name << " at " << height_m;
    }
  }
}

TEST(DistanceQuery, BoxEdge_StaysSharp) {
  const Transform<Object, Object> place = OddPlace();
  Queried model(OddBox());
  std::mt19937 random(4);
  for (int i = 0; i < kProbes; ++i) {
    // On and around the edge between two faces: there the true zero level has a corner.
    const float along_m = Uniform(random, -0.04F, 0.04F);
    const Vec3 x_m(along_m, 0.03F + Uniform(random, -2e-3F, 0.0F),
                   0.02F + Uniform(random, -2e-3F, 0.0F));
    const float truth_m = std::max({x_m.y() - 0.03F, x_m.z() - 0.02F, std::abs(x_m.x()) - 0.04F});
    EXPECT_NEAR(model.At(place * x_m).distance_m, truth_m, 5e-4F);
    // Just outside of the edge nothing of the object is left.
    const Vec3 outside_m(along_m, 0.0305F, 0.0205F);
    EXPECT_GT(model.At(place * outside_m).distance_m, 0.0F);
  }
}

TEST(DistanceQuery, GrooveBetweenTwoPlanes_IsOutside) {
  // An inner corner: the floor z = 0 for x > 0 and the wall x = 0 for z > 0; the object is beyond.
  const Transform<Object, Object> place = OddPlace();
  Shape corner;
  corner.area_m2 = 0.008F;
  corner.distance_m = [](const Vec3& x_m) { return std::min(x_m.x(), x_m.z()); };
  corner.random_point = [](std::mt19937& random) {
    const float out_m = Uniform(random, 0.001F, 0.05F);
    const float along_m = Uniform(random, -0.04F, 0.04F);
    return Uniform(random, -1.0F, 1.0F) < 0.0F
               ? SurfacePoint{Vec3(out_m, along_m, 0.0F), Vec3::UnitZ()}
               : SurfacePoint{Vec3(0.0F, along_m, out_m), Vec3::UnitX()};
  };
  Queried model(Moved(corner, place));
  std::mt19937 random(4);
  for (int i = 0; i < kProbes; ++i) {
    const Vec3 x_m(Uniform(random, -4e-3F, 5e-3F), Uniform(random, -0.03F, 0.03F),
                   Uniform(random, -4e-3F, 5e-3F));
    EXPECT_NEAR(model.At(place * x_m).distance_m, corner.distance_m(x_m), 5e-4F) << x_m.transpose();
  }
}

TEST(DistanceQuery, Gradient_IsUnitAndFitsTheDistance) {
  constexpr float kStep_m = 2e-4F;
  for (const Case& tested : Cases()) {
    Queried model(tested.shape, Noisy());
    std::mt19937 random(5);
    int bent = 0;
    for (int i = 0; i < kProbes; ++i) {
      const SurfacePoint point = tested.shape.random_point(random);
      const Vec3 x_m = point.position_m + Uniform(random, -2e-3F, 4e-3F) * point.normal;
      const DistanceQuery here = model.At(x_m);
      EXPECT_NEAR(here.gradient.norm(), 1.0F, 1e-4F);
      Vec3 numerical;
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = kStep_m * Vec3::Unit(axis);
        numerical(axis) =
            (model.At(x_m + step).distance_m - model.At(x_m - step).distance_m) / (2.0F * kStep_m);
      }
      if ((numerical - here.gradient).norm() > 0.2F) ++bent;
    }
    // Along creases the distance has no gradient; else both agree.
    EXPECT_LE(bent, kProbes / 20) << tested.name;
  }
}

TEST(DistanceQuery, AcrossCellBorders_DistanceDoesNotJump) {
  const Shape sphere = OddSphere();
  Queried model(sphere, Noisy());
  constexpr float kStep_m = 1e-4F;
  constexpr float kLargestJump_m = 1e-4F;
  const Vec3 center_m = OddPlace().translation();
  for (const float radius_m : {0.038F, 0.040F, 0.044F}) {
    for (const Vec3& axis :
         {Vec3(1.0F, 0.0F, 0.0F), Vec3(0.3F, 0.9F, 0.1F), Vec3(-0.5F, 0.2F, 0.8F)}) {
      const Vec3 first = axis.unitOrthogonal();
      const Vec3 second = axis.normalized().cross(first);
      float previous_m = model.At(center_m + radius_m * first).distance_m;
      for (float angle = 0.0F; angle < 6.28F; angle += kStep_m / radius_m) {
        const Vec3 x_m = center_m + radius_m * (std::cos(angle) * first + std::sin(angle) * second);
        const float distance_m = model.At(x_m).distance_m;
        ASSERT_LT(std::abs(distance_m - previous_m), kLargestJump_m) << x_m.transpose();
        previous_m = distance_m;
      }
    }
  }
}

TEST(DistanceQuery, FarApproach_DistanceDoesNotJump) {
  const Shape sphere = OddSphere();
  Queried model(sphere, Noisy());
  const Vec3 center_m = OddPlace().translation();
  const Vec3 direction = Vec3(0.4F, -0.7F, 0.5F).normalized();
  float previous_m = model.At(center_m + 0.04F * direction).distance_m;
  for (float radius_m = 0.0402F; radius_m < 0.2F; radius_m += 2e-4F) {
    const float distance_m = model.At(center_m + radius_m * direction).distance_m;
    ASSERT_NEAR(distance_m - previous_m, 2e-4F, 3e-4F) << radius_m;
    previous_m = distance_m;
  }
}

TEST(DistanceQuery, NoisyObservations_StandardDeviationIsHonest) {
  for (const Case& tested : Cases()) {
    Queried model(tested.shape, Noisy());
    std::mt19937 random(6);
    double sum_squared = 0.0;
    int beyond = 0;
    for (int i = 0; i < kProbes; ++i) {
      const SurfacePoint point = tested.shape.random_point(random);
      const Vec3 x_m = point.position_m + Uniform(random, -3e-3F, 3e-3F) * point.normal;
      const DistanceQuery answer = model.At(x_m);
      ASSERT_GT(answer.variance_m2, 0.0F);
      const float sigmas =
          (answer.distance_m - tested.shape.distance_m(x_m)) / std::sqrt(answer.variance_m2);
      sum_squared += static_cast<double>(sigmas * sigmas);
      if (std::abs(sigmas) > 3.0F) ++beyond;
    }
    const double rms_sigmas = std::sqrt(sum_squared / kProbes);
    // On the safe side, by the model's own noise floor, but not meaningless.
    EXPECT_LT(rms_sigmas, 1.5) << tested.name;
    EXPECT_GT(rms_sigmas, 0.05) << tested.name;
    EXPECT_LE(beyond, kProbes / 100) << tested.name;
  }
}

TEST(DistanceQuery, AwayFromTheData_VarianceGrows) {
  Queried model(OddPlane(), Noisy());
  const Transform<Object, Object> place = OddPlace();
  for (const Vec3& direction : {Vec3(0.0F, 0.0F, 1.0F), Vec3(0.0F, 0.0F, -1.0F)}) {
    float previous_m2 = 0.0F;
    for (const float height_m : {0.0F, 0.004F, 0.008F, 0.012F, 0.016F, 0.03F, 0.1F, 1.0F}) {
      const float variance_m2 = model.At(place * Vec3(height_m * direction)).variance_m2;
      EXPECT_GT(variance_m2, previous_m2) << height_m;
      previous_m2 = variance_m2;
    }
  }
  const float inside_m2 = model.At(place * Vec3(0.0F, 0.0F, 0.0F)).variance_m2;
  EXPECT_GT(model.At(place * Vec3(0.070F, 0.0F, 0.0F)).variance_m2, 2.0F * inside_m2);
}

TEST(DistanceQuery, InBounds_OnlyWhereSurfaceWasSeenNearby) {
  Queried model(OddPlane());  // Seen for |x|, |y| < 6 cm.
  const Transform<Object, Object> place = OddPlace();
  EXPECT_TRUE(model.At(place * Vec3(0.01F, -0.02F, 0.0F)).in_bounds);
  EXPECT_TRUE(model.At(place * Vec3(0.01F, -0.02F, 0.010F)).in_bounds);
  EXPECT_TRUE(model.At(place * Vec3(0.01F, -0.02F, -0.010F)).in_bounds);
  EXPECT_FALSE(model.At(place * Vec3(0.01F, -0.02F, 0.05F)).in_bounds);
  EXPECT_FALSE(model.At(place * Vec3(0.075F, 0.0F, 0.0F)).in_bounds);
  EXPECT_FALSE(model.At(place * Vec3(0.2F, 0.0F, 0.0F)).in_bounds);
}

TEST(DistanceQuery, FarPoint_DistanceAndSignAreSensible) {
  // From afar the nearest sample stands for the surface; near edges that is all that is known.
  constexpr float kSampleSpacing_m = 3e-3F;
  for (const Case& tested :
       {Case{"sphere", OddSphere()}, Case{"box", OddBox()}, Case{"cylinder", OddCylinder()}}) {
    Queried model(tested.shape);
    std::mt19937 random(8);
    for (int i = 0; i < 300; ++i) {
      const Vec3 direction = Vec3(Uniform(random, -1.0F, 1.0F), Uniform(random, -1.0F, 1.0F),
                                  Uniform(random, -1.0F, 1.0F))
                                 .normalized();
      for (const float range_m : {0.09F, 0.3F, 2.0F, 50.0F}) {
        const Vec3 x_m = range_m * direction;
        const DistanceQuery answer = model.At(x_m);
        const float truth_m = tested.shape.distance_m(x_m);
        EXPECT_NEAR(answer.distance_m, truth_m, kSampleSpacing_m)
            << tested.name << " " << x_m.transpose();
        EXPECT_GT(answer.gradient.dot(tested.shape.Gradient(x_m)), 0.95F) << tested.name;
        EXPECT_FALSE(answer.in_bounds);
      }
    }
  }
  Queried sphere(OddSphere());
  const DistanceQuery middle = sphere.At(OddPlace().translation());
  EXPECT_NEAR(middle.distance_m, -0.04F, 1e-3F);
  EXPECT_FALSE(middle.in_bounds);
}

TEST(DistanceQuery, ModelJustStarted_AnswersBeforeTraining) {
  auto field = std::make_unique<EdgeField>();
  field->Start({});
  Counters counters;
  std::mt19937 random(1);
  EXPECT_EQ(field->Insert(Observe({Vec3::Zero(), Vec3::UnitZ()}, {}, random), 1, counters),
            EdgeField::Fusion::kAdded);
  GpWorkspace<profiles::Edge::kMaxTrainingSamples> workspace;
  DistanceQuerier<profiles::Edge> querier(*field, workspace, kSupport_m);
  const auto answer = querier.Query(Vec3(0.0F, 0.0F, 0.003F));
  ASSERT_EQ(answer.status, Status::kOk);
  EXPECT_NEAR(answer.value.distance_m, 0.003F, 1e-5F);
  EXPECT_GT(answer.value.variance_m2, 0.0F);
}

TEST(DistanceQuery, EmptyModel_SaysNotInitialised) {
  auto field = std::make_unique<EdgeField>();
  field->Start({});
  GpWorkspace<profiles::Edge::kMaxTrainingSamples> workspace;
  DistanceQuerier<profiles::Edge> querier(*field, workspace, kSupport_m);
  EXPECT_EQ(querier.Query(Vec3::Zero()).status, Status::kNotInitialised);
}

TEST(DistanceQuery, NotFinitePoint_SaysOutOfBounds) {
  const auto field = MakeModel(OddPlane());
  GpWorkspace<profiles::Edge::kMaxTrainingSamples> workspace;
  DistanceQuerier<profiles::Edge> querier(*field, workspace, kSupport_m);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
          -std::numeric_limits<float>::infinity(), 1e30F}) {
      Vec3 x_m = Vec3::Zero();
      x_m(axis) = bad;
      EXPECT_EQ(querier.Query(x_m).status, Status::kOutOfBounds);
    }
  }
}

/// Observations at one place whose normals all contradict each other: nothing but strays.
std::unique_ptr<EdgeField> StraysAlone() {
  auto field = std::make_unique<EdgeField>();
  field->Start({});
  Counters counters;
  std::mt19937 random(1);
  for (int corner = 0; corner < 27; ++corner) {
    const Vec3 direction(static_cast<float>(corner % 3 - 1), static_cast<float>(corner / 3 % 3 - 1),
                         static_cast<float>(corner / 9 - 1));
    const auto on_axes = (direction.array() != 0.0F).count();
    if (on_axes != 1 && on_axes != 3) continue;
    const Vec3 x_m = Vec3(0.005F, 0.006F, 0.007F) + 0.001F * direction;
    (void)field->Insert(Observe({x_m, direction.normalized()}, {}, random), 1, counters);
  }
  return field;
}

TEST(DistanceQuery, PointOnAStraySample_IsOnTheSurface) {
  const auto field = StraysAlone();
  ASSERT_EQ(field->store().size(), 14);
  GpWorkspace<profiles::Edge::kMaxTrainingSamples> workspace;
  DistanceQuerier<profiles::Edge> querier(*field, workspace, kSupport_m);
  field->store().ForEach([&](Handle, const auto& cluster) {
    for (const ModelSample& sample : cluster.samples) {
      const auto answer = querier.Query(sample.position_m);
      ASSERT_EQ(answer.status, Status::kOk);
      EXPECT_EQ(answer.value.distance_m, 0.0F);
      EXPECT_NEAR(answer.value.gradient.norm(), 1.0F, 1e-3F);
      EXPECT_TRUE(std::isfinite(answer.value.variance_m2));
      // And so close to it that squares of the distance vanish.
      const auto beside = querier.Query(Vec3(sample.position_m + Vec3::Constant(1e-30F)));
      EXPECT_TRUE(std::isfinite(beside.value.distance_m));
      EXPECT_TRUE(beside.value.gradient.allFinite());
    }
  });
}

/// More local GPs around a place than are listed there: five sides in each of many cells.
std::unique_ptr<EdgeField> Crowded() {
  auto field = std::make_unique<EdgeField>();
  field->Start({});
  Counters counters;
  std::mt19937 random(2);
  for (int cell = 0; cell < 125; ++cell) {
    const Vec3 corner_m =
        0.02F * Vec3(static_cast<float>(cell % 5) - 2.0F, static_cast<float>(cell / 5 % 5) - 2.0F,
                     static_cast<float>(cell / 25) - 2.0F);
    for (int side = 0; side < 5; ++side) {
      const Vec3 normal = (side % 2 == 0 ? 1.0F : -1.0F) * Vec3::Unit(side / 2);
      for (int i = 0; i < 4; ++i) {
        const Vec3 in_cell_m(Uniform(random, 0.001F, 0.019F), Uniform(random, 0.001F, 0.019F),
                             Uniform(random, 0.001F, 0.019F));
        (void)field->Insert(Observe({corner_m + in_cell_m, normal}, {}, random), 1, counters);
      }
    }
  }
  return field;
}

TEST(LocalSurfaceOfACrowd, FieldAtAPoint_DoesNotDependOnTheBoxThatWasGathered) {
  const auto field = Crowded();
  ASSERT_GT(field->store().size(), 500);
  LocalSurface<profiles::Edge> around_point(*field);
  LocalSurface<profiles::Edge> around_all(*field);
  constexpr float kReach_m = 0.008F;
  const Vec3 half_m = Vec3::Constant(0.05F);
  around_all.Gather(-half_m, half_m, kReach_m);
  EXPECT_TRUE(around_all.HasSampleNear(Vec3::Constant(0.04F), Vec3::Constant(0.06F), 0.001F))
      << "the last of the cells that were gathered";
  std::mt19937 random(3);
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 x_m(Uniform(random, -0.05F, 0.05F), Uniform(random, -0.05F, 0.05F),
                   Uniform(random, -0.05F, 0.05F));
    around_point.Gather(x_m, x_m, kReach_m);
    const auto a = around_point.Evaluate(x_m);
    const auto b = around_all.Evaluate(x_m);
    ASSERT_EQ(a.found, b.found) << x_m.transpose();
    if (!a.found) continue;
    ++found;
    EXPECT_EQ(a.nearest_m, b.nearest_m);
    EXPECT_EQ(a.distance_m, b.distance_m);
    EXPECT_EQ(a.gradient, b.gradient);
  }
  EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace disflow::testing
