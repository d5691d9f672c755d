// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/kernel_widths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "disflow/flow/normal_equations.h"

namespace disflow {
namespace {

constexpr int kFrames = 200;

KernelWidths After(float surface, float edges, int frames) {
  KernelWidths widths;
  for (int frame = 0; frame < frames; ++frame) widths.Learn(surface, edges);
  return widths;
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

TEST(KernelWidths, BeforeAnythingIsLearnt_AreOneDeviation) {
  const KernelWidths widths;
  EXPECT_FLOAT_EQ(widths.of_surface(), 1.0F);
  EXPECT_FLOAT_EQ(widths.of_edges(), 1.0F);
}

TEST(KernelWidths, WhereResidualsAreTheNoiseThatIsKnown_MostOfWhatTheyTellCounts) {
  const float learnt = After(1.0F, 1.0F, kFrames).of_surface();
  // Cramer and Rao's bound is 1.
  EXPECT_GT(VarianceOfMean(KernelWidths().of_surface()), 1.8);
  EXPECT_LT(VarianceOfMean(learnt), 1.4);
}

TEST(KernelWidths, WhereResidualsAreCloserThanTheirNoise_StayNarrow) {
  const KernelWidths widths = After(0.3F, 0.5F, kFrames);
  EXPECT_FLOAT_EQ(widths.of_surface(), 1.0F);
  EXPECT_FLOAT_EQ(widths.of_edges(), 1.0F);
}

TEST(KernelWidths, OfAModelThatIsOff_AreNoWiderThanOfNoise) {
  const KernelWidths of_noise = After(1.0F, 1.0F, kFrames);
  const KernelWidths of_errors = After(5.0F, 30.0F, kFrames);
  EXPECT_FLOAT_EQ(of_errors.of_surface(), of_noise.of_surface());
  EXPECT_FLOAT_EQ(of_errors.of_edges(), of_noise.of_edges());
}

TEST(KernelWidths, OfSurfaceAndEdges_AreLearntApart) {
  const KernelWidths widths = After(1.0F, 0.4F, kFrames);
  EXPECT_GT(widths.of_surface(), 1.9F);
  EXPECT_FLOAT_EQ(widths.of_edges(), 1.0F);
}

TEST(KernelWidths, AfterOneFrameAmongMany_HardlyChange) {
  KernelWidths widths = After(0.8F, 0.8F, kFrames);
  const float before = widths.of_surface();
  widths.Learn(0.1F, 20.0F);
  EXPECT_NEAR(widths.of_surface(), before, 0.25F);
  EXPECT_NEAR(widths.of_edges(), before, 0.25F);
}

TEST(KernelWidths, WhereAFrameTellsNothing_StayAsTheyWere) {
  KernelWidths widths = After(0.8F, 0.9F, kFrames);
  const float surface = widths.of_surface();
  const float edges = widths.of_edges();
  for (const float nothing : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN()}) {
    widths.Learn(nothing, nothing);
  }
  EXPECT_FLOAT_EQ(widths.of_surface(), surface);
  EXPECT_FLOAT_EQ(widths.of_edges(), edges);
}

}  // namespace
}  // namespace disflow
