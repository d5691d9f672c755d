// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/memory/fixed_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace disflow::testing {
namespace {

TEST(FixedPoint, Numbers_AreRoundedToTheNearestStep) {
  for (float steps = -32766.9F; steps < 32767.0F; steps += 0.37F)
    EXPECT_LE(std::abs(static_cast<float>(RoundToSteps(steps)) - steps), 0.5F);
  for (int steps = -32767; steps <= 32767; ++steps)
    EXPECT_EQ(RoundToSteps(static_cast<float>(steps)), steps);
}

TEST(FixedPoint, Rounding_IsSymmetric) {
  for (float steps = 0.0F; steps < 3.0F; steps += 0.125F)
    EXPECT_EQ(RoundToSteps(-steps), -RoundToSteps(steps));
}

TEST(FixedPoint, WhatIsOutOfRange_BecomesItsEnd) {
  using Limits = std::numeric_limits<float>;
  for (const float steps : {32767.4F, 40000.0F, 1e20F, Limits::max(), Limits::infinity()}) {
    EXPECT_EQ(RoundToSteps(steps), 32767);
    EXPECT_EQ(RoundToSteps(-steps), -32767);
  }
  EXPECT_EQ(RoundToSteps(Limits::quiet_NaN()), -32767);
}

}  // namespace
}  // namespace disflow::testing
