// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/edge_residual.h"

#include <gtest/gtest.h>

#include <memory>

#include "disflow/flow/registration.h"
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

}  // namespace
}  // namespace disflow::testing
