// SPDX-License-Identifier: BSD-3-Clause
#include "statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace disflow::apps {
namespace {

TEST(StatisticsTest, KnownValues_GiveKnownFigures) {
  const Statistics s = Summarise({4.0, 1.0, 3.0, 2.0, 5.0});
  EXPECT_EQ(s.count, 5U);
  EXPECT_DOUBLE_EQ(s.mean, 3.0);
  EXPECT_DOUBLE_EQ(s.rms, std::sqrt(11.0));
  EXPECT_DOUBLE_EQ(s.median, 3.0);
  EXPECT_DOUBLE_EQ(s.p95, 4.8);
  EXPECT_DOUBLE_EQ(s.max, 5.0);
}

TEST(StatisticsTest, EvenCount_MedianLiesBetween) {
  EXPECT_DOUBLE_EQ(Summarise({1.0, 2.0, 10.0, 20.0}).median, 6.0);
}

TEST(StatisticsTest, NoValues_GivesNanNotZero) {
  const Statistics s = Summarise({});
  EXPECT_EQ(s.count, 0U);
  EXPECT_TRUE(std::isnan(s.mean));
  EXPECT_TRUE(std::isnan(s.max));
}

TEST(StatisticsTest, Quantile_OfOneValueIsThatValue) {
  EXPECT_DOUBLE_EQ(Quantile({7.0}, 0.0), 7.0);
  EXPECT_DOUBLE_EQ(Quantile({7.0}, 0.99), 7.0);
}

TEST(AreaUnderAccuracyTest, PerfectRun_IsOne) {
  EXPECT_DOUBLE_EQ(AreaUnderAccuracy({0.0, 0.0, 0.0}, 3, 0.10), 1.0);
}

TEST(AreaUnderAccuracyTest, ConstantError_IsTheRestOfTheRange) {
  EXPECT_DOUBLE_EQ(AreaUnderAccuracy({0.025, 0.025}, 2, 0.10), 0.75);
}

TEST(AreaUnderAccuracyTest, ErrorsBeyondTheLimit_AddNothing) {
  EXPECT_DOUBLE_EQ(AreaUnderAccuracy({0.0, 0.10, 5.0, HUGE_VAL}, 4, 0.10), 0.25);
}

TEST(AreaUnderAccuracyTest, EvenlySpreadErrors_AreHalf) {
  std::vector<double> errors;
  for (int i = 0; i < 1000; ++i) errors.push_back(0.10 * (i + 0.5) / 1000.0);
  EXPECT_NEAR(AreaUnderAccuracy(errors, errors.size(), 0.10), 0.5, 1e-12);
}

TEST(AreaUnderAccuracyTest, MissingFrames_CountAsNeverAccurate) {
  EXPECT_DOUBLE_EQ(AreaUnderAccuracy({0.0, 0.0, 0.0}, 4, 0.10), 0.75);
}

TEST(AreaUnderAccuracyTest, EqualsTheFineSumOverThresholds) {
  const std::vector<double> errors = {0.003, 0.0111, 0.05, 0.0999, 0.3};
  constexpr int kSteps = 1000000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double d = 0.10 * (i + 0.5) / kSteps;
    int accurate = 0;
    for (const double error : errors) accurate += error < d ? 1 : 0;
    sum += accurate / 5.0 / kSteps;
  }
  EXPECT_NEAR(AreaUnderAccuracy(errors, errors.size(), 0.10), sum, 1e-5);
}

}  // namespace
}  // namespace disflow::apps
