// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/memory/packed_variance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace disflow::testing {
namespace {

static_assert(sizeof(PackedVariance) == 2);

float RoundTrip(float value) { return PackedVariance(value).value(); }

TEST(PackedVariance, RoundTrip_KeepsElevenBits) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-43.0F, 19.9F);
  for (int i = 0; i < 100000; ++i) {
    const float value = std::exp2(exponent(random));
    EXPECT_NEAR(RoundTrip(value) / value, 1.0F, std::exp2(-11.0F) + 1e-7F);
  }
}

TEST(PackedVariance, PackingAgain_ChangesNothing) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> exponent(-50.0F, 25.0F);
  for (int i = 0; i < 10000; ++i) {
    const float once = RoundTrip(std::exp2(exponent(random)));
    EXPECT_EQ(RoundTrip(once), once);
  }
}

TEST(PackedVariance, LargerNumbers_AreNeverSmallerPacked) {
  float before = 0.0F;
  for (float exponent = -60.0F; exponent < 60.0F; exponent += 1e-3F) {
    const float packed = RoundTrip(std::exp2(exponent));
    EXPECT_GE(packed, before);
    before = packed;
  }
}

TEST(PackedVariance, SmallNumbers_AreOffByLessThanTheSmallest) {
  const float smallest = std::exp2(-44.0F);
  for (float value = 0.0F; value < 4.0F * smallest; value += 0.01F * smallest)
    EXPECT_LT(std::abs(RoundTrip(value) - value), 1.01F * smallest);
  EXPECT_EQ(RoundTrip(0.0F), 0.0F);
  EXPECT_EQ(RoundTrip(std::numeric_limits<float>::denorm_min()), 0.0F);
}

TEST(PackedVariance, WhatIsNoVariance_BecomesAnEnd) {
  using Limits = std::numeric_limits<float>;
  EXPECT_EQ(RoundTrip(Limits::infinity()), PackedVariance::kLargest);
  EXPECT_EQ(RoundTrip(Limits::max()), PackedVariance::kLargest);
  EXPECT_EQ(RoundTrip(2e6F), PackedVariance::kLargest);
  EXPECT_EQ(RoundTrip(PackedVariance::kLargest), PackedVariance::kLargest);
  EXPECT_EQ(RoundTrip(-1.0F), 0.0F);
  EXPECT_EQ(RoundTrip(-Limits::infinity()), 0.0F);
  EXPECT_EQ(RoundTrip(Limits::quiet_NaN()), 0.0F);
  EXPECT_EQ(RoundTrip(-Limits::quiet_NaN()), 0.0F);
}

}  // namespace
}  // namespace disflow::testing
