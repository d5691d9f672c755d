// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/edge_rounding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "disflow/field/edge_map.h"
#include "disflow/flow/edge_residual.h"

namespace disflow::testing {
namespace {

constexpr float kRadius_m = 0.004F;
constexpr float kStd_m = 2e-4F;

/// A block that fills y < 0, z > 0 behind a face towards -z; its edge along x would be at the
/// origin if it were sharp.
const Vec3 kNormal = -Vec3::UnitZ();

/// How far along `outward` the block reaches: found by walking over the rounding.
float Reach(float radius_m, const Vec3& outward) {
  float reach_m = -1.0F;
  for (int i = 0; i <= 2000; ++i) {
    const float angle = 1.5707963F * static_cast<float>(i) / 2000.0F;
    const Vec3 place_m(0.0F, radius_m * (std::sin(angle) - 1.0F),
                       radius_m * (1.0F - std::cos(angle)));
    reach_m = std::max(reach_m, outward.dot(place_m));
  }
  return reach_m;
}

/// The outline seen at a slant to the face: placed where its ray meets the face, as in a frame.
/// @param slant_rad Between the ray and the face's inward normal.
EdgePoint Seen(float radius_m, float slant_rad) {
  EdgePoint point;
  point.ray = Vec3(0.0F, std::sin(slant_rad), std::cos(slant_rad));
  point.direction = Vec3::UnitX();
  point.normal = kNormal;
  point.outward = Vec3(0.0F, std::cos(slant_rad), -std::sin(slant_rad));
  // On the face, where outward . x is the block's reach.
  point.position_m = Vec3(0.0F, Reach(radius_m, point.outward) / point.outward.y(), 0.0F);
  point.variance_m2 = kStd_m * kStd_m;
  point.depth_variance_m2 = 1e-8F;
  return point;
}

TEST(EdgeRounding, OffsetOfTheOutline_IsThatOfARoundedRightAngle) {
  for (float slant_rad = 0.0F; slant_rad < 1.57F; slant_rad += 0.1F) {
    const Vec3 outward(0.0F, std::cos(slant_rad), -std::sin(slant_rad));
    EXPECT_NEAR(kRadius_m * OutlineOffset(outward, kNormal), Reach(kRadius_m, outward), 1e-6F)
        << "slant " << slant_rad << " rad";
  }
}

TEST(EdgeRounding, SharpEdge_HasItsOutlineAtItsPlaceFromAnywhere) {
  const ModelEdge edge = MakeModelEdge(Seen(0.0F, 0.1F), 1);
  for (const float slant_rad : {0.1F, 0.4F, 0.9F, 1.2F}) {
    EXPECT_NEAR(EdgeResidualOf(Seen(0.0F, slant_rad), edge, 0.0F).distance_m, 0.0F, 1e-6F);
  }
}

TEST(EdgeRounding, RoundedEdgeSeenFromElsewhere_AgreesAtItsRadiusAlone) {
  const ModelEdge edge = MakeModelEdge(Seen(kRadius_m, 0.1F), 1);
  for (const float slant_rad : {0.1F, 0.4F, 0.9F, 1.2F}) {
    const EdgePoint point = Seen(kRadius_m, slant_rad);
    EXPECT_NEAR(EdgeResidualOf(point, edge, kRadius_m).distance_m, 0.0F, 2e-5F)
        << "slant " << slant_rad << " rad";
  }
  // Taken for a sharp one, it seems to have moved by more than the outline's noise.
  EXPECT_LT(EdgeResidualOf(Seen(kRadius_m, 0.9F), edge, 0.0F).distance_m, -2.0F * kStd_m);
}

TEST(EdgeRounding, DerivativeByTheRadius_IsTheDifferenceQuotient) {
  const ModelEdge edge = MakeModelEdge(Seen(kRadius_m, 0.1F), 1);
  const EdgePoint point = Seen(kRadius_m, 0.8F);
  const float step_m = 0.002F;
  const float quotient = (EdgeResidualOf(point, edge, kRadius_m + step_m).distance_m -
                          EdgeResidualOf(point, edge, kRadius_m).distance_m) /
                         step_m;
  EXPECT_NEAR(EdgeResidualOf(point, edge, kRadius_m).per_radius, quotient, 1e-3F);
}

TEST(EdgeRounding, EdgeSeenFromAllSides_IsWhereTheFacesWouldMeet) {
  ModelEdge edge = MakeModelEdge(Seen(kRadius_m, 0.0F), 1);
  std::uint32_t frame = 2;
  for (float slant_rad = 0.05F; slant_rad < 1.2F; slant_rad += 0.05F)
    MergeIntoEdge(Seen(kRadius_m, slant_rad), frame++, edge);
  // What the rounding adds to the place is known, so the corner can be told.
  const Vec3 corner_m = edge.position_m - kRadius_m * edge.position_per_radius;
  EXPECT_LT(corner_m.norm(), 1e-4F);
  EXPECT_GT(edge.position_m.norm(), 3e-4F) << "the outline wanders";
}

/// The same edge when the face towards -z has turned away: the outline of the face towards +y.
EdgePoint SeenFromTheOtherFace(float radius_m, float slant_rad) {
  EdgePoint point = Seen(radius_m, slant_rad);
  point.normal = Vec3::UnitY();
  // On that face, where outward . x is the block's reach.
  point.position_m = Vec3(0.0F, 0.0F, Reach(radius_m, point.outward) / point.outward.z());
  return point;
}

TEST(EdgeRounding, EdgeOfOneFace_IsFoundAgainAsTheOutlineOfTheOther) {
  const ModelEdge edge = MakeModelEdge(Seen(kRadius_m, 0.1F), 1);
  for (const float slant_rad : {0.5F, 0.9F, 1.4F}) {
    const EdgePoint point = SeenFromTheOtherFace(kRadius_m, slant_rad);
    EXPECT_TRUE(IsSeenAs(edge, point));
    EXPECT_NEAR(EdgeResidualOf(point, edge, kRadius_m).distance_m, 0.0F, 2e-5F)
        << "slant " << slant_rad << " rad";
  }
}

TEST(EdgeRounding, OutlineOfSurfaceThatHasTurnedALittle_IsNotThatEdge) {
  const ModelEdge edge = MakeModelEdge(Seen(kRadius_m, 0.1F), 1);
  for (const float turn_rad : {0.8F, 0.9F, 1.0F}) {
    EdgePoint point = Seen(kRadius_m, 0.1F);
    point.normal = Vec3(0.0F, std::sin(turn_rad), -std::cos(turn_rad));
    EXPECT_FALSE(IsSeenAs(edge, point)) << "round things: their outline moves over them";
  }
}

TEST(EdgeRounding, EdgeSeenFromBothFaces_IsWhereTheyWouldMeetAndKeepsItsNormal) {
  ModelEdge edge = MakeModelEdge(Seen(kRadius_m, 0.0F), 1);
  std::uint32_t frame = 2;
  for (float slant_rad = 0.05F; slant_rad < 0.7F; slant_rad += 0.05F)
    MergeIntoEdge(Seen(kRadius_m, slant_rad), frame++, edge);
  for (float slant_rad = 0.8F; slant_rad < 1.5F; slant_rad += 0.05F)
    MergeIntoEdge(SeenFromTheOtherFace(kRadius_m, slant_rad), frame++, edge);
  EXPECT_TRUE(edge.normal.isApprox(kNormal));
  const Vec3 corner_m = edge.position_m - kRadius_m * edge.position_per_radius;
  EXPECT_LT(corner_m.norm(), 1e-4F);
}

TEST(EdgeRounding, TwentyFramesThatErrAlike_TellNoMoreThanOne) {
  const EdgeRounding before;
  // A frame that tells the radius with a standard deviation of a millimetre.
  const float told = 1e6F;
  EdgeRounding known = before;
  for (int i = 0; i < static_cast<int>(kMaxEdgeWeight); ++i) {
    const float information = 1.0F / known.variance_m2 + told;
    const float mean_m = (known.radius_m / known.variance_m2 + told * 0.001F) / information;
    known = Remember(known, {mean_m, 1.0F / information});
  }
  const float expected_information = 1.0F / before.variance_m2 + told;
  const float expected_m =
      (before.radius_m / before.variance_m2 + told * 0.001F) / expected_information;
  EXPECT_NEAR(known.variance_m2 * expected_information, 1.0F, 0.05F);
  EXPECT_NEAR(known.radius_m, expected_m, 2e-5F);
}

TEST(EdgeRounding, FrameWithoutEdges_ChangesNothingButTheCertainty) {
  const EdgeRounding before{0.002F, 1e-6F};
  const EdgeRounding after = Remember(before, before);
  EXPECT_EQ(after.radius_m, before.radius_m);
  EXPECT_GE(after.variance_m2, before.variance_m2);
  EXPECT_LT(after.variance_m2, 1.01F * before.variance_m2);
}

}  // namespace
}  // namespace disflow::testing
