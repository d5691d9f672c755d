// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "tracked_sequence.h"

namespace disflow::testing {
namespace {

// A box of 0.37 x 0.14 x 0.47 m: 0.6 m^2 pass through more cells of 2 cm than there are local GPs.
constexpr double kSize = 2.2;

/// A large box in fast motion.
TrackedSequence Track(host::MaskKind mask, const Config& config = {}) {
  constexpr int kFrames = 90;
  host::SimulationOptions options = Scene(host::ObjectKind::kBox, kFrames);
  options.motion = host::MotionKind::kFast;
  options.mask = mask;
  TrackedSequence sequence(options, config, kSize);
  sequence.Run(kFrames);
  return sequence;
}

double LargestError_m(const TrackedSequence& sequence) {
  double largest_m = 0.0;
  for (const TrackedFrame& frame : sequence.frames()) largest_m = std::max(largest_m, frame.off_m);
  return largest_m;
}

int FramesNotMeasured(const TrackedSequence& sequence) {
  return static_cast<int>(std::count_if(
      sequence.frames().begin(), sequence.frames().end(),
      [](const TrackedFrame& frame) { return frame.estimate.status != Status::kOk; }));
}

TEST(LargeObject, FitsIntoTheProfileInCoarserCells_AndNextToNothingOfItIsForgotten) {
  const TrackedSequence fitted = Track(host::MaskKind::kGt);
  Config config;
  config.field.fit_to_object = 0;
  const TrackedSequence overfull = Track(host::MaskKind::kGt, config);
  EXPECT_GT(fitted.tracker().field().coarseness(), 1.3F);
  EXPECT_EQ(overfull.tracker().field().coarseness(), 1.0F);
  EXPECT_GT(overfull.tracker().totals().clusters_evicted, 500U);
  EXPECT_LT(10 * fitted.tracker().totals().clusters_evicted,
            overfull.tracker().totals().clusters_evicted);
  EXPECT_EQ(FramesNotMeasured(fitted), 0);
  EXPECT_LT(LargestError_m(fitted), 0.01);
}

TEST(LargeObject, WithoutAMask_IsFollowedWhenAWholeFaceComesIntoViewAtOnce) {
  const TrackedSequence sequence = Track(host::MaskKind::kNone);
  EXPECT_EQ(FramesNotMeasured(sequence), 0);
  EXPECT_LT(LargestError_m(sequence), 0.02);
  EXPECT_EQ(sequence.last().estimate.state, TrackingState::kTracking);
}

TEST(LargeObject, AThingThatFits_KeepsTheCellsThatAreSet) {
  host::SimulationOptions options = Scene(host::ObjectKind::kBox, 2);
  TrackedSequence sequence(options);
  sequence.Run(2);
  EXPECT_EQ(sequence.tracker().field().config().cell_size_m, Config{}.field.cell_size_m);
}

}  // namespace
}  // namespace disflow::testing
