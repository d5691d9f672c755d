// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/block_contrasts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace disflow {
namespace {

TEST(ThirdOrderVariance, OfAnySurfaceOfSecondOrder_IsZero) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> coefficient(-0.1F, 0.1F);
  for (int i = 0; i < 100; ++i) {
    float c[6];
    for (float& value : c) value = coefficient(random);
    BlockMeans means;
    for (int k = 0; k < 9; ++k) {
      const auto x = static_cast<float>(k % 3 - 1);
      const auto y = static_cast<float>(k / 3 - 1);
      means[static_cast<std::size_t>(k)] =
          1.4F + c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y;
    }
    // What rounding leaves of numbers about 1.
    EXPECT_LT(ThirdOrderVariance(means), 1e-12F);
  }
}

/// Windows of independent normal means with a standard deviation.
std::vector<float> VariancesOfWhiteNoise(float std) {
  std::mt19937 random(2);
  std::normal_distribution<float> noise(1.5F, std);
  std::vector<float> variances;
  for (int i = 0; i < 20000; ++i) {
    BlockMeans means;
    for (float& mean : means) mean = noise(random);
    variances.push_back(ThirdOrderVariance(means));
  }
  return variances;
}

TEST(ThirdOrderVariance, OfWhiteNoise_IsItsVarianceInTheMean) {
  constexpr float kStd = 0.003F;
  const std::vector<float> variances = VariancesOfWhiteNoise(kStd);
  double sum = 0.0;
  for (const float variance : variances) sum += static_cast<double>(variance);
  EXPECT_NEAR(sum / static_cast<double>(variances.size()) / static_cast<double>(kStd * kStd), 1.0,
              0.03);
}

TEST(ThirdOrderVariance, Median_IsTheStatedShareOfTheMean) {
  constexpr float kStd = 0.003F;
  std::vector<float> variances = VariancesOfWhiteNoise(kStd);
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  EXPECT_NEAR(*middle / (kStd * kStd), kThirdOrderMedian, 0.03F);
}

}  // namespace
}  // namespace disflow
