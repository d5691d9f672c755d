// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/edge_sliver.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "model_builder.h"

namespace disflow {
namespace {

using testing::EdgeField;

constexpr float kMostCos = 0.3F;
Vec3 Half_m() { return {0.05F, 0.04F, 0.03F}; }

/// A point of the upper edge of a box that faces +y, seen by who looks down at the upper face.
/// @param side_cos Between the normal of the side below the edge and the way to the eye; negative
/// where that side has turned away.
EdgePoint UpperEdge(float x_m, float side_cos) {
  EdgePoint point;
  point.position_m = Vec3(x_m, Half_m().y(), Half_m().z());
  point.normal = Vec3::UnitZ();
  point.direction = Vec3::UnitX();
  point.ray = Vec3(0.0F, -side_cos, -std::sqrt(1.0F - side_cos * side_cos));
  point.outward = point.ray.cross(point.direction).normalized();
  if (point.outward.y() < 0.0F) point.outward = -point.outward;
  point.variance_m2 = 1e-7F;
  return point;
}

template <class Expected>
void ExpectAlongTheEdge(const EdgeField& box, Expected&& expected) {
  for (const float x_m : {-0.03F, -0.01F, 0.0F, 0.017F, 0.033F}) {
    for (const float side_cos : {-0.5F, -0.2F, -0.1F, 0.05F, 0.1F, 0.2F, 0.25F, 0.5F, 0.8F}) {
      EXPECT_EQ(MayEndInSliver(box, UpperEdge(x_m, side_cos), kMostCos), expected(side_cos))
          << x_m << " " << side_cos;
    }
  }
}

TEST(EdgeSliver, ASideThatShowsTooFlatForAnOutline_IsOneUntilItHasTurnedAway) {
  const auto box = testing::MakeModel(testing::Box(Half_m(), 0.0015F));
  ExpectAlongTheEdge(*box, [](float side_cos) { return side_cos > 0.0F && side_cos < kMostCos; });
}

TEST(EdgeSliver, OfANoisyModel_IsToldAsWell) {
  testing::Observing noisy;
  noisy.noise_m = 1e-3F;
  noisy.normal_noise = 0.1F;
  const auto box = testing::MakeModel(testing::Box(Half_m(), 0.0015F), noisy);
  ExpectAlongTheEdge(*box, [](float side_cos) { return side_cos > 0.0F && side_cos < kMostCos; });
}

TEST(EdgeSliver, WhereNoOtherFaceIsKnown_ThereIsNone) {
  const auto sheet = testing::MakeModel(
      testing::Moved(testing::Plane(0.05F),
                     Transform<Object, Object>(Mat3::Identity(), Vec3(0.0F, 0.0F, Half_m().z()))));
  const auto nothing = std::make_unique<EdgeField>();
  nothing->Start({});
  ExpectAlongTheEdge(*sheet, [](float) { return false; });
  ExpectAlongTheEdge(*nothing, [](float) { return false; });
}

// The surface of a ball turns away gradually: nothing of it meets the outline at an angle.
TEST(EdgeSliver, OutlineOfABall_HasNone) {
  constexpr float kRadius_m = 0.04F;
  const auto ball = testing::MakeModel(testing::Sphere(kRadius_m, Vec3::Zero()));
  for (float angle = 0.0F; angle < 6.28F; angle += 0.3F) {
    EdgePoint rim;
    rim.outward = rim.normal = Vec3(std::cos(angle), std::sin(angle), 0.0F);
    rim.position_m = kRadius_m * rim.outward;
    rim.ray = -Vec3::UnitZ();
    rim.direction = rim.ray.cross(rim.outward);
    EXPECT_FALSE(MayEndInSliver(*ball, rim, kMostCos)) << angle;
  }
}

TEST(EdgeSliver, EdgesThatMayEndInOne_AreDoubtedByPixelsWhereverTheObjectIs) {
  const auto box = testing::MakeModel(testing::Box(Half_m(), 0.0015F));
  const PoseObjectFromCamera T_oc(testing::OddPlace().rotation(), Vec3(0.1F, -0.2F, 0.5F));
  const PoseCameraFromObject T_co = T_oc.Inverse();
  const auto in_camera = [&T_co](EdgePoint point) {
    point.position_m = T_co * point.position_m;
    for (Vec3* const v : {&point.normal, &point.direction, &point.ray, &point.outward})
      *v = T_co.rotation() * *v;
    return point;
  };
  std::array<EdgePoint, 2> edges = {in_camera(UpperEdge(0.01F, 0.1F)),
                                    in_camera(UpperEdge(0.01F, -0.1F))};
  const float before_m2 = edges[0].variance_m2;
  PinholeCamera camera;
  camera.fx_px = camera.fy_px = 600.0F;
  DoubtSlivers(*box, T_oc, camera, kMostCos, edges);
  const float pixel_m = edges[0].position_m.z() / 600.0F;
  EXPECT_NEAR(edges[0].variance_m2 - before_m2, 4.0F * pixel_m * pixel_m / 3.0F, 1e-9F);
  EXPECT_EQ(edges[1].variance_m2, before_m2);
}

}  // namespace
}  // namespace disflow
