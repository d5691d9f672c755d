// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/registration_pace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace disflow {
namespace {

constexpr RobustScale kStart{0.005F, 0.0025F};
constexpr float kNoise_m = 3e-4F;

Vec6 Step(float shift_m, float turn_rad) {
  Vec6 xi;
  xi << 0.0F, shift_m, 0.0F, turn_rad, 0.0F, 0.0F;
  return xi;
}

/// The pace after it has ended, all steps alike.
RegistrationPace Ended(StepLimit limit, const Vec6& xi, float std_m) {
  RegistrationPace pace(kStart, limit);
  while (!pace.done()) pace.Advance(xi, std_m);
  return pace;
}

TEST(RegistrationPace, NoStepAllowed_IsDoneAtOnce) {
  EXPECT_TRUE(RegistrationPace(kStart, {0}).done());
  EXPECT_TRUE(RegistrationPace(kStart, {-1, true}).done());
}

TEST(RegistrationPace, WhatIsSearchedFor_HalvesItsKernelsToTheLastStep) {
  RegistrationPace pace(kStart, {8});
  for (int step = 0; step < 8; ++step) {
    ASSERT_FALSE(pace.done());
    EXPECT_FLOAT_EQ(pace.scale().surface_m, std::ldexp(kStart.surface_m, -step));
    EXPECT_FLOAT_EQ(pace.scale().edges_m, std::ldexp(kStart.edges_m, -step));
    pace.Advance(Step(5e-5F, 5e-4F), kNoise_m);
  }
  EXPECT_TRUE(pace.done());
}

TEST(RegistrationPace, PredictionThatWasRight_EndsOnceTheKernelIsNarrowerThanTheNoise) {
  const RegistrationPace pace = Ended({8, true}, Step(5e-5F, 5e-4F), kNoise_m);
  EXPECT_EQ(pace.steps(), 4);
  EXPECT_LT(pace.scale().surface_m, kNoise_m);
}

TEST(RegistrationPace, LessNoise_TakesMoreSteps) {
  const Vec6 xi = Step(5e-5F, 5e-4F);
  int before = 0;
  for (const float std_m : {1e-3F, 3e-4F, 1e-4F, 2e-5F, 5e-6F}) {
    const RegistrationPace pace = Ended({12, true}, xi, std_m);
    EXPECT_LT(pace.scale().surface_m, std_m);
    EXPECT_GT(pace.steps(), before);
    before = pace.steps();
  }
}

TEST(RegistrationPace, StepsThatStillMove_AreAllTaken) {
  EXPECT_EQ(Ended({8, true}, Step(2e-4F, 0.0F), kNoise_m).steps(), 8);
  EXPECT_EQ(Ended({8, true}, Step(0.0F, 2e-3F), kNoise_m).steps(), 8);
}

TEST(RegistrationPace, SlidesAndTurns_AreMatchedAnew) {
  RegistrationPace pace(kStart, {8, true});
  EXPECT_EQ(pace.matching(), Matching::kSearch);
  pace.Advance(Step(3e-3F, 0.0F), kNoise_m);
  EXPECT_EQ(pace.matching(), Matching::kSearch);
  pace.Advance(Step(1e-3F, 0.0F), kNoise_m);
  EXPECT_EQ(pace.matching(), Matching::kKeep);
  pace.Advance(Step(1e-4F, 1e-3F), kNoise_m);
  EXPECT_EQ(pace.matching(), Matching::kLinear);
  pace.Advance(Step(0.0F, 3e-2F), kNoise_m);
  EXPECT_EQ(pace.matching(), Matching::kSearch);
}

TEST(RegistrationPace, StepsThatAreNoNumbers_End) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(Ended({8, true}, Step(nan, nan), nan).steps(), 8);
}

}  // namespace
}  // namespace disflow
