// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tracked_sequence.h"

namespace disflow::testing {
namespace {

/// A thing that is small, far away or seen by a camera of few pixels.
struct FewPixels {
  std::string name;
  host::ObjectKind object;
  host::NoiseKind noise;
  int width_px;
  int height_px;
  double distance_m;
  unsigned seed;
};

void PrintTo(const FewPixels& thing, std::ostream* out) { *out << thing.name; }

class FewPixelsTest : public ::testing::TestWithParam<FewPixels> {};

// Six unknowns need a handful of samples, not as many as a thing nearby has.
TEST_P(FewPixelsTest, OfASmallThing_AreEnoughToTrackItInEveryImage) {
  constexpr int kFrames = 120;
  constexpr double kNear_m = 0.02;
  constexpr double kMostOff_m = 0.05;
  const FewPixels& thing = GetParam();
  host::SimulationOptions options = Scene(thing.object, kFrames);
  options.noise = thing.noise;
  options.width_px = thing.width_px;
  options.height_px = thing.height_px;
  options.distance_m = thing.distance_m;
  options.seed = thing.seed;
  TrackedSequence sequence(options);
  sequence.Run(kFrames);
  int near = 0;
  for (const TrackedFrame& frame : sequence.frames()) {
    EXPECT_NE(frame.estimate.state, TrackingState::kLost) << "frame " << frame.index;
    EXPECT_LT(frame.off_m, kMostOff_m) << "frame " << frame.index;
    if (frame.off_m < kNear_m) ++near;
  }
  EXPECT_EQ(sequence.last().estimate.reset_counter, 0);
  EXPECT_GT(near, kFrames * 9 / 10);
}

INSTANTIATE_TEST_SUITE_P(
    Things, FewPixelsTest,
    ::testing::Values(FewPixels{"FlatBoxInAnImage213PixelsWide", host::ObjectKind::kFlatBox,
                                host::NoiseKind::kKinect, 213, 120, 0.8, 1},
                      FewPixels{"BottleAcrossARoom", host::ObjectKind::kBottle,
                                host::NoiseKind::kKinect, 320, 180, 1.6, 2},
                      FewPixels{"FlatBoxAcrossARoom", host::ObjectKind::kFlatBox,
                                host::NoiseKind::kClean, 640, 360, 2.2, 2},
                      FewPixels{"BracketOfThinSheet", host::ObjectKind::kBracket,
                                host::NoiseKind::kClean, 320, 180, 1.0, 2}),
    [](const auto& thing) { return thing.param.name; });

}  // namespace
}  // namespace disflow::testing
