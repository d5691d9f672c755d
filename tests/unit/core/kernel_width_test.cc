// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/kernel_width.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "disflow/flow/normal_equations.h"

namespace disflow {
namespace {

constexpr int kFrames = 200;

KernelWidth AfterSpread(float spread) {
  KernelWidth width;
  for (int frame = 0; frame < kFrames; ++frame) width.Learn(spread);
  return width;
}

/// Variance of the mean of normal noise as registration would take it, in that of the plain mean.
double VarianceOfMean(float width) {
  constexpr int kTrials = 2000;
  constexpr int kPoints = 100;
  std::mt19937 random(11);
  std::normal_distribution<float> noise(0.0F, 1.0F);
  double square = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<float> points(kPoints);
    for (float& point : points) point = noise(random);
    float mean = 0.0F;
    for (int step = 0; step < 30; ++step) {
      float weights = 0.0F;
      float sum = 0.0F;
      for (const float point : points) {
        const float weight = GemanMcClure(point - mean, width);
        weights += weight;
        sum += weight * point;
      }
      mean = sum / weights;
    }
    square += static_cast<double>(mean) * static_cast<double>(mean);
  }
  return square / kTrials * kPoints;
}

TEST(KernelWidth, BeforeAnythingIsLearnt_IsOneDeviation) {
  EXPECT_FLOAT_EQ(KernelWidth().factor(), 1.0F);
}

TEST(KernelWidth, WhereResidualsAreTheNoiseThatIsKnown_MostOfWhatTheyTellCounts) {
  // Cramer and Rao's bound is 1.
  EXPECT_GT(VarianceOfMean(KernelWidth().factor()), 1.8);
  EXPECT_LT(VarianceOfMean(AfterSpread(1.0F).factor()), 1.4);
}

TEST(KernelWidth, WhereResidualsAreCloserThanTheirNoise_StaysNarrow) {
  EXPECT_FLOAT_EQ(AfterSpread(0.3F).factor(), 1.0F);
  EXPECT_FLOAT_EQ(AfterSpread(0.5F).factor(), 1.0F);
}

TEST(KernelWidth, OfAModelThatIsOff_IsNarrowerTheMoreItIsOff) {
  float before = AfterSpread(1.0F).factor();
  for (const float spread : {1.2F, 1.5F, 1.8F}) {
    const float factor = AfterSpread(spread).factor();
    EXPECT_LT(factor, before) << spread;
    before = factor;
  }
  for (const float spread : {2.0F, 5.0F, 30.0F})
    EXPECT_FLOAT_EQ(AfterSpread(spread).factor(), 1.0F);
}

TEST(KernelWidth, AfterOneFrameAmongMany_HardlyChanges) {
  for (const float odd : {0.1F, 20.0F}) {
    KernelWidth width = AfterSpread(0.8F);
    const float before = width.factor();
    width.Learn(odd);
    EXPECT_NEAR(width.factor(), before, 0.25F);
  }
}

TEST(KernelWidth, WhereAFrameTellsNothing_StaysAsItWas) {
  KernelWidth width = AfterSpread(0.8F);
  const float before = width.factor();
  for (const float nothing : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN()}) {
    width.Learn(nothing);
  }
  EXPECT_FLOAT_EQ(width.factor(), before);
}

}  // namespace
}  // namespace disflow
