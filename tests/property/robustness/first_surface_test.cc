// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "tracked_sequence.h"

namespace disflow::testing {
namespace {

constexpr int kFrames = 40;

/// A box without a mask, and crumbs of noise that are nearer than it.
class FirstSurfaceTest : public ::testing::Test {
 protected:
  FirstSurfaceTest()
      : simulation_(Options(), host::MakeObjectMesh(host::ObjectKind::kBox)),
        tracker_(std::make_unique<EdgeTracker>(Config{})) {}

  /// Tracks all frames; the first `crumbs` of them have one, each elsewhere.
  void Track(int crumbs) {
    for (int i = 0; i < kFrames; ++i) {
      DepthFrame frame;
      simulation_.Render(i, frame);
      depth_m_.assign(static_cast<const float*>(frame.depth.data),
                      static_cast<const float*>(frame.depth.data) +
                          frame.depth.width_px * frame.depth.height_px);
      if (i < crumbs) DrawCrumb(i, frame.depth.width_px);
      frame.depth.data = depth_m_.data();
      (void)tracker_->Process(frame, estimate_);
      longest_wrong_ = std::max(longest_wrong_, IsAtTheBox(i) ? 0 : i + 1);
    }
  }

  /// Whether the origin, the middle of what was seen first, is within the box.
  [[nodiscard]] bool IsAtTheBox(int frame) const {
    const host::Vec3d truth_m = simulation_.TruthAt(frame).object.pose.translation();
    return (estimate_.T_co.translation().cast<double>() - truth_m).norm() < 0.15;
  }

  [[nodiscard]] const Estimate& last() const { return estimate_; }
  /// Frames until the box was followed for good.
  [[nodiscard]] int longest_wrong() const { return longest_wrong_; }

 private:
  static host::SimulationOptions Options() {
    host::SimulationOptions options = Scene(host::ObjectKind::kBox, kFrames);
    options.mask = host::MaskKind::kNone;
    return options;
  }

  /// 20 pixels wide and high, near the top of the image, left or right, nearer or farther: not
  /// within a decimetre of those in the three images before.
  void DrawCrumb(int i, int width_px) {
    constexpr int kSide_px = 20;
    const int u_first = i % 2 == 0 ? 40 : 580;
    const float depth_m = i % 4 < 2 ? 0.25F : 0.42F;
    for (int v = 4; v < 4 + kSide_px; ++v)
      std::fill_n(depth_m_.begin() + v * width_px + u_first, kSide_px, depth_m);
  }

  host::Simulation simulation_;
  std::unique_ptr<EdgeTracker> tracker_;
  std::vector<float> depth_m_;
  Estimate estimate_;
  int longest_wrong_ = 0;
};

TEST_F(FirstSurfaceTest, ThatIsTheObject_IsTakenAtOnce) {
  Track(0);
  EXPECT_EQ(longest_wrong(), 0);
  EXPECT_EQ(last().reset_counter, 0);
}

TEST_F(FirstSurfaceTest, ThatIsGoneInTheNextImage_IsGivenUpAsSoonAsItIsLost) {
  Track(1);
  EXPECT_LE(longest_wrong(), 1 + MonitorConfig{}.lost_after_frames);
  EXPECT_EQ(last().state, TrackingState::kTracking);
  EXPECT_EQ(last().reset_counter, 1);
}

TEST_F(FirstSurfaceTest, ThatIsACrumbInEveryImage_DoesNotKeepTheObjectFromBeingFound) {
  Track(kFrames);
  EXPECT_LE(longest_wrong(), 2 + MonitorConfig{}.lost_after_frames);
  EXPECT_EQ(last().state, TrackingState::kTracking);
  EXPECT_EQ(last().reset_counter, 1);
}

}  // namespace
}  // namespace disflow::testing
