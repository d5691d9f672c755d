// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/contour_bend.h"

#include <gtest/gtest.h>

#include <cmath>

namespace disflow {
namespace {

constexpr float kRadius_m = 0.05F;
constexpr float kNear_m = 0.003F;
constexpr float kInner_m = 0.008F;
constexpr float kPrecise_rad2 = 1e-6F;

/// Sine of the angle between ray and a circle's tangent, so far across the rays from its outline.
float SineOnCircle(float across_m) {
  const float cosine = 1.0F - across_m / kRadius_m;
  return std::sqrt(1.0F - cosine * cosine);
}

OutlineProfile Circle(float variance_rad2) {
  return {SineOnCircle(kNear_m), SineOnCircle(kInner_m), kNear_m, kInner_m, variance_rad2};
}

/// From where the plane at the near window meets the outline's ray to where the circle touches it.
float BehindOnCircle() {
  const float sine = SineOnCircle(kNear_m);
  const float cosine = 1.0F - kNear_m / kRadius_m;
  return kRadius_m * sine - kNear_m * cosine / sine;
}

TEST(ContourBend, OfACircle_IsHowFarItBendsOn) {
  EXPECT_NEAR(ContourBend(Circle(kPrecise_rad2)), BehindOnCircle(), 0.01F * BehindOnCircle());
  EXPECT_GT(BehindOnCircle(), 0.005F);
}

TEST(ContourBend, OfAFlatFace_IsNothingHoweverSteepItIsSeen) {
  for (const float cosine : {0.3F, 0.5F, 0.8F, 0.99F}) {
    EXPECT_LT(ContourBend({cosine, cosine, kNear_m, kInner_m, kPrecise_rad2}), 1e-5F) << cosine;
  }
}

TEST(ContourBend, WhatNoiseHides_IsLeftOpen) {
  constexpr float kVague_rad2 = 1.0F;
  const float open = std::sqrt(0.5F) * BehindOnCircle();
  EXPECT_NEAR(ContourBend(Circle(kVague_rad2)), open, 0.03F * BehindOnCircle());
  const float sine = SineOnCircle(kNear_m);
  EXPECT_NEAR(ContourBend({sine, sine, kNear_m, kInner_m, kVague_rad2}), open,
              0.03F * BehindOnCircle());
}

TEST(ContourBend, FaceSeenFromTheFront_HasNearlyNoneThoughNothingElseIsKnown) {
  EXPECT_LT(ContourBend({0.9F, 0.9F, kNear_m, kInner_m, 1.0F}), kNear_m);
}

TEST(ContourBend, AnyInput_GivesADistance) {
  for (const float cosine : {-0.5F, 0.0F, 1e-7F, 1.0F, 1.5F}) {
    for (const float near_m : {-1.0F, 0.0F, 1e-9F, 1.0F}) {
      for (const float variance_rad2 : {0.0F, 1e10F}) {
        const float bend_m = ContourBend({cosine, 1.0F - cosine, near_m, 0.01F, variance_rad2});
        EXPECT_TRUE(std::isfinite(bend_m) && bend_m >= 0.0F)
            << bend_m << " of " << cosine << ' ' << near_m << ' ' << variance_rad2;
      }
    }
  }
}

}  // namespace
}  // namespace disflow
