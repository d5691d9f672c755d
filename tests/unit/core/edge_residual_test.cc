// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/edge_residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "disflow/flow/registration.h"
#include "disflow/flow/registration_impl.h"
#include "disflow/limits.h"

namespace disflow::testing {
namespace {

using Residuals = EdgeResiduals<profiles::Micro>;
using MicroRegistration = Registration<profiles::Micro>;
constexpr float kScale_m = 0.002F;

/// A point of an edge along x at a place across it, seen straight from ahead.
EdgePoint PointAt(float y_m, bool steady) {
  EdgePoint point;
  point.position_m = Vec3(0.0F, y_m, 0.5F);
  point.direction = Vec3::UnitX();
  point.normal = -Vec3::UnitZ();
  point.ray = Vec3::UnitZ();
  point.outward = Vec3::UnitY();
  point.variance_m2 = 1e-7F;
  point.steady = steady;
  return point;
}

/// A model with one well-known edge at y = 0.
Residuals::Model KnownEdge() {
  Residuals::Model model;
  model.Start();
  Counters counters;
  for (std::uint32_t frame = 0; frame < 20; ++frame)
    model.Insert(PointAt(0.0F, true), 0.004F, frame, counters);
  return model;
}

TEST(EdgeResiduals, PointNearAKnownEdge_IsMatchedWhetherSteadyOrNot) {
  const Residuals::Model model = KnownEdge();
  const RegistrationConfig config;
  for (const bool steady : {true, false}) {
    Residuals::Edges edges;
    ASSERT_TRUE(edges.push_back(PointAt(0.001F, steady)));
    const auto index = std::make_unique<Residuals::Index>();
    Residuals residuals(model, edges, config, *index);
    for (const Matching matching : {Matching::kSearch, Matching::kKeep, Matching::kLinear}) {
      const Residual residual = residuals.At(0, PoseObjectFromCamera(), kScale_m, matching);
      EXPECT_EQ(residual.status, ResidualStatus::kMatched);
      EXPECT_NEAR(residual.distance_m, 0.001F, 1e-5F);
    }
  }
}

TEST(EdgeResiduals, PointFarFromAllEdges_IsMissedOnlyIfSteady) {
  const Residuals::Model model = KnownEdge();
  const RegistrationConfig config;
  Residuals::Edges edges;
  ASSERT_TRUE(edges.push_back(PointAt(0.1F, true)));
  ASSERT_TRUE(edges.push_back(PointAt(0.1F, false)));
  const auto index = std::make_unique<Residuals::Index>();
  Residuals residuals(model, edges, config, *index);
  for (const Matching matching : {Matching::kSearch, Matching::kKeep, Matching::kLinear}) {
    EXPECT_EQ(residuals.At(0, PoseObjectFromCamera(), kScale_m, matching).status,
              ResidualStatus::kUnmatched);
    EXPECT_EQ(residuals.At(1, PoseObjectFromCamera(), kScale_m, matching).status,
              ResidualStatus::kUnexpected);
  }
}

TEST(EdgeResiduals, RoundOutlineBesideAnEdge_LeavesTheEdgesScore) {
  const Residuals::Model model = KnownEdge();
  const RegistrationConfig config;
  Residuals::Edges edges;
  auto registration = std::make_unique<MicroRegistration>();
  registration->SetObservations(MicroRegistration::Samples(), edges);
  EXPECT_EQ(registration->EdgeScore(model, config, PoseObjectFromCamera()), 0.0F);
  ASSERT_TRUE(edges.push_back(PointAt(0.0F, true)));
  const float alone = registration->EdgeScore(model, config, PoseObjectFromCamera());
  EXPECT_GT(alone, 0.99F);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(edges.push_back(PointAt(0.1F, false)));
  EXPECT_EQ(registration->EdgeScore(model, config, PoseObjectFromCamera()), alone);
  ASSERT_TRUE(edges.push_back(PointAt(0.1F, true)));
  EXPECT_NEAR(registration->EdgeScore(model, config, PoseObjectFromCamera()), 0.5F * alone, 1e-5F);
}

/// How far edges seem to be off that lie `std_m` off the known one, taken for as good as others.
float SpreadOf(float std_m, int points) {
  const Residuals::Model model = KnownEdge();
  const RegistrationConfig config;
  std::mt19937 random(3);
  std::normal_distribution<float> off_m(0.0F, std_m);
  Residuals::Edges edges;
  for (int i = 0; i < points; ++i) EXPECT_TRUE(edges.push_back(PointAt(off_m(random), true)));
  // What is in no model says nothing.
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(edges.push_back(PointAt(0.1F, true)));
  const auto index = std::make_unique<Residuals::Index>();
  Residuals residuals(model, edges, config, *index);
  for (int i = 0; i < edges.size(); ++i)
    (void)residuals.At(i, PoseObjectFromCamera(), kScale_m, Matching::kSearch);
  return disflow::SpreadOf<profiles::Micro::kMaxEdgePoints>(residuals, PoseObjectFromCamera());
}

TEST(EdgeResiduals, Spread_IsThatOfThePlacesInTheirStandardDeviations) {
  const float alone_m = std::sqrt(PointAt(0.0F, true).variance_m2 * (1.0F + 1.0F / 20.0F));
  for (const float ratio : {0.3F, 1.0F, 2.5F})
    EXPECT_NEAR(SpreadOf(ratio * alone_m, 100), ratio, 0.2F * ratio);
}

TEST(EdgeResiduals, SpreadOfAFewPoints_IsNotKnown) {
  EXPECT_EQ(SpreadOf(1e-3F, 8), 0.0F);
  EXPECT_EQ(SpreadOf(1e-3F, 0), 0.0F);
}

}  // namespace
}  // namespace disflow::testing
