// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/outline_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace disflow {
namespace {

/// Spread of places that are `ratio` times as far off as they are taken for.
float SpreadOf(float ratio, int places, std::mt19937& random) {
  constexpr float kMedianOfNormal = 0.6745F;
  std::normal_distribution<float> off(0.0F, ratio);
  std::vector<float> deviations;
  for (int i = 0; i < places; ++i) deviations.push_back(std::abs(off(random)));
  std::sort(deviations.begin(), deviations.end());
  return deviations[deviations.size() / 2] / kMedianOfNormal;
}

TEST(OutlineScale, OutlinesThatAreOffByMoreThanTheyAreRagged_AreTakenForAsNoisyAsTheyAre) {
  for (const float truth : {0.4F, 1.0F, 1.5F, 2.4F, 5.0F}) {
    std::mt19937 random(7);
    OutlineScale scale;
    float mean = 0.0F;
    constexpr int kFrames = 400;
    for (int frame = 0; frame < 2 * kFrames; ++frame) {
      scale.Learn(OutlineSource::kDepth,
                  SpreadOf(truth / scale.Of(OutlineSource::kDepth), 50, random));
      if (frame >= kFrames) mean += scale.Of(OutlineSource::kDepth) / kFrames;
    }
    // Never for better than they look.
    EXPECT_NEAR(mean, std::max(truth, 1.0F), 0.08F * std::max(truth, 1.0F)) << truth;
  }
}

TEST(OutlineScale, DepthAndMasks_AreKnownApart) {
  OutlineScale scale;
  for (int frame = 0; frame < 50; ++frame) {
    scale.Learn(OutlineSource::kDepth, 2.0F / scale.Of(OutlineSource::kDepth));
    scale.Learn(OutlineSource::kMask, 1.0F);
  }
  EXPECT_NEAR(scale.Of(OutlineSource::kDepth), 2.0F, 0.1F);
  EXPECT_EQ(scale.Of(OutlineSource::kMask), 1.0F);
}

TEST(OutlineScale, OneFrame_ChangesLittle) {
  OutlineScale scale;
  scale.Learn(OutlineSource::kDepth, 1e6F);
  EXPECT_LT(scale.Of(OutlineSource::kDepth), 1.1F) << "the pose may have been off";
  scale.Learn(OutlineSource::kDepth, std::numeric_limits<float>::infinity());
  EXPECT_LT(scale.Of(OutlineSource::kDepth), 1.2F);
}

TEST(OutlineScale, FramesThatTellNothing_ChangeNothing) {
  OutlineScale scale;
  scale.Learn(OutlineSource::kDepth, 1.7F);
  const float before = scale.Of(OutlineSource::kDepth);
  EXPECT_GT(before, 1.0F);
  for (const float nothing : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN()})
    scale.Learn(OutlineSource::kDepth, nothing);
  EXPECT_EQ(scale.Of(OutlineSource::kDepth), before);
}

}  // namespace
}  // namespace disflow
