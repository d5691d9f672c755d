// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/block_contrasts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
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
/// Mean correlation of the pixels of two blocks in a row, so many blocks apart.
double BlockCorrelation(int edge_px, int apart, double correlation_px) {
  double sum = 0.0;
  for (int i = 0; i < edge_px; ++i) {
    for (int j = 0; j < edge_px; ++j) {
      const double distance = (i - j + apart * edge_px) / correlation_px;
      sum += std::exp(-0.25 * distance * distance);
    }
  }
  return sum / (edge_px * edge_px);
}

/// What ThirdOrderVariance() is in the mean, times the pixels of a block.
double ThirdOrderOf(int edge_px, double correlation_px) {
  const auto of = [&](const std::array<double, 3>& contrast) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      squares += contrast[i] * contrast[i];
      for (std::size_t j = 0; j < 3; ++j) {
        const int apart = std::abs(static_cast<int>(i) - static_cast<int>(j));
        sum += contrast[i] * contrast[j] * BlockCorrelation(edge_px, apart, correlation_px);
      }
    }
    return sum / squares;
  };
  const double first = of({-1.0, 0.0, 1.0});
  const double second = of({1.0, -2.0, 1.0});
  return (2.0 * first * second + second * second) / 3.0 * edge_px * edge_px;
}

TEST(CorrelationFactor, OfGaussianCorrelation_IsWhatContrastsOfTheMeansLackToTheirVariance) {
  for (const int edge_px : {2, 3, 4, 5}) {
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      const double correlation_px = share * edge_px;
      const double seen = ThirdOrderOf(edge_px, correlation_px);
      const double growth = ThirdOrderOf(2 * edge_px, correlation_px) / seen;
      const double mean_variance = std::pow(BlockCorrelation(edge_px, 0, correlation_px), 2);
      const double factor = mean_variance * edge_px * edge_px / seen;
      EXPECT_NEAR(static_cast<double>(CorrelationFactor(static_cast<float>(growth))), factor,
                  0.1 * factor)
          << edge_px << " px, correlation " << correlation_px << " px";
    }
  }
}

TEST(CorrelationFactor, OfWhatGrowsAsCurvatureDoes_IsOne) {
  // A contrast of third order grows with the cube of the width, times the root of the pixels.
  EXPECT_EQ(CorrelationFactor(std::pow(2.0F, 8.0F)), 1.0F);
  EXPECT_EQ(CorrelationFactor(1.0F), 1.0F);
  EXPECT_EQ(CorrelationFactor(0.5F), 1.0F);
  EXPECT_EQ(CorrelationFactor(std::numeric_limits<float>::quiet_NaN()), 1.0F);
}

}  // namespace disflow
