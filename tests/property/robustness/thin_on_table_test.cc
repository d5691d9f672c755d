// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "tracked_sequence.h"

namespace disflow::testing {
namespace {

constexpr int kImages = 60;

/// Things on a table under a mask, so small in the image that the mask's tolerance is as wide as
/// they are. They stand for a second, then they are lifted off.
TrackedSequence OnTable(host::ObjectKind object, double distance_m) {
  host::SimulationOptions options = Scene(object, kImages);
  options.noise = host::NoiseKind::kD415;
  options.support = host::SupportKind::kTable;
  options.width_px = 320;
  options.height_px = 180;
  options.distance_m = distance_m;
  TrackedSequence sequence(options);
  sequence.Run(kImages);
  return sequence;
}

TEST(MaskedThingOnItsTable, ThinnerThanTheMasksTolerance_IsTrackedFromTheFirstImageOn) {
  for (const double distance_m : {0.0, 0.7}) {
    const TrackedSequence screwdriver = OnTable(host::ObjectKind::kScrewdriver, distance_m);
    for (const TrackedFrame& frame : screwdriver.frames())
      EXPECT_EQ(frame.estimate.status, Status::kOk) << distance_m << ' ' << frame.index;
    EXPECT_EQ(screwdriver.last().estimate.reset_counter, 0);
    // It is as good as round: it turns about its axis unseen, and slides along it.
    EXPECT_LT(screwdriver.last().off_m, 0.06);
  }
}

TEST(MaskedThingOnItsTable, HardlyWiderThanTheMasksTolerance_IsTrackedFromTheFirstImageOn) {
  const TrackedSequence box = OnTable(host::ObjectKind::kFlatBox, 0.0);
  EXPECT_FALSE(box.WasEver(TrackingState::kLost));
  EXPECT_EQ(box.last().estimate.reset_counter, 0);
  EXPECT_LT(box.last().off_m, 0.01);
  EXPECT_LT(box.last().off_deg, 5.0);
}

}  // namespace
}  // namespace disflow::testing
