// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/fast_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace disflow {
namespace {

TEST(FastExp, RelativeError_IsBelowOneMillionth) {
  double worst = 0.0;
  for (float x = 0.0F; x >= -79.0F; x -= 1.7e-5F * (1.0F - x)) {
    const double exact = std::exp(static_cast<double>(x));
    worst = std::max(worst, std::abs(static_cast<double>(FastExpNonPositive(x)) / exact - 1.0));
  }
  EXPECT_LT(worst, 5e-7);
}

TEST(FastExp, AtZero_IsExactlyOne) {
  EXPECT_EQ(FastExpNonPositive(0.0F), 1.0F);
  EXPECT_EQ(FastExpNonPositive(-0.0F), 1.0F);
}

TEST(FastExp, NearZero_IsRoundedWell) {
  constexpr float kUlp = std::numeric_limits<float>::epsilon() / 2.0F;
  for (float x = -1e-8F; x > -0.01F; x *= 1.1F)
    EXPECT_NEAR(FastExpNonPositive(x), std::exp(x), kUlp) << x;
}

TEST(FastExp, FarBelow_IsZero) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float x : {-80.5F, -88.0F, -104.0F, -1e4F, -1e9F, -1e30F, -kInfinity}) {
    EXPECT_EQ(FastExpNonPositive(x), 0.0F) << x;
  }
}

TEST(FastExp, NotANumber_IsHarmless) {
  EXPECT_EQ(FastExpNonPositive(std::numeric_limits<float>::quiet_NaN()), 0.0F);
}

TEST(FastExp, Falls_WithItsArgument) {
  // Neighbours may differ by rounding, distant ones must not.
  for (float x = 0.0F; x > -75.0F; x -= 1e-3F) {
    EXPECT_LT(FastExpNonPositive(x - 1e-3F), FastExpNonPositive(x)) << x;
  }
}

TEST(FastInverseSqrt, RelativeError_IsBelowOneThirdOfAMillionth) {
  double worst = 0.0;
  for (float x = 1e-36F; x < 1e36F; x *= 1.00007F) {
    const double exact = 1.0 / std::sqrt(static_cast<double>(x));
    worst = std::max(worst, std::abs(static_cast<double>(FastInverseSqrt(x)) / exact - 1.0));
  }
  EXPECT_LT(worst, 3e-7);
}

TEST(FastMath, InALoop_GivesTheSameBitsAsAlone) {
  std::array<float, 67> x;
  std::array<float, 67> exp_of;
  std::array<float, 67> inverse_sqrt_of;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = -0.37F * static_cast<float>(i * i);
  for (std::size_t i = 0; i < x.size(); ++i) {
    exp_of[i] = FastExpNonPositive(x[i]);
    inverse_sqrt_of[i] = FastInverseSqrt(0.1F - x[i]);
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    volatile float alone = x[i];
    EXPECT_EQ(exp_of[i], FastExpNonPositive(alone));
    EXPECT_EQ(inverse_sqrt_of[i], FastInverseSqrt(0.1F - alone));
  }
}

}  // namespace
}  // namespace disflow
