// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/memory/median.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace disflow {
namespace {

float Median(std::vector<float> values) {
  return MedianOf(values.data(), values.data() + values.size());
}

TEST(Median, FewValues_HaveTheUpperOneInTheMiddle) {
  EXPECT_EQ(Median({}), 0.0F);
  EXPECT_EQ(Median({3.0F}), 3.0F);
  EXPECT_EQ(Median({3.0F, 1.0F}), 3.0F);
  EXPECT_EQ(Median({3.0F, 1.0F, 2.0F}), 2.0F);
  EXPECT_EQ(Median({4.0F, 1.0F, 3.0F, 2.0F}), 3.0F);
}

TEST(Median, OfNormalDistribution_TellsItsStandardDeviation) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal(0.0F, 2.0F);
  std::vector<float> values(20'000);
  for (float& value : values) value = std::abs(normal(random));
  EXPECT_NEAR(Median(values) / kMedianPerSigma, 2.0F, 0.05F);
}

}  // namespace
}  // namespace disflow
