// SPDX-License-Identifier: BSD-3-Clause
#include "objects/tracked_object.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace disflow::apps {
namespace {

constexpr int kWidth_px = 160;
constexpr int kHeight_px = 120;
constexpr float kWall_m = 1.5F;
constexpr float kLeft_m = 0.5F;
constexpr float kRight_m = 0.7F;
constexpr float kRightMiddle = 0.73F;  ///< Share of the image's width.

/// A run with one object; its frames show two things before a wall.
class TrackedObjectTest : public ::testing::Test {
 protected:
  TrackedObjectTest() : depth_m_(kPixels, kWall_m), labels_(kPixels, 0) {
    Draw(20, 60, kLeft_m, 1);
    Draw(95, 140, kRight_m, 2);
  }

  void Draw(int u_begin, int u_end, float depth_m, std::uint8_t label) {
    for (int v = 30; v < 90; ++v) {
      for (int u = u_begin; u < u_end; ++u) {
        const auto i = static_cast<std::size_t>(v * kWidth_px + u);
        depth_m_[i] = depth_m;
        labels_[i] = label;
      }
    }
  }

  /// How far off the object is by the next frame; 0 if it says nothing.
  float TrackNext(bool masked = false) {
    // No two images of a camera are the same to the bit.
    shown_m_ = depth_m_;
    for (float& depth_m : shown_m_) depth_m *= 1.0F + 1e-6F * static_cast<float>(frames_);
    DepthFrame frame;
    frame.depth = {shown_m_.data(),       kWidth_px, kHeight_px, 4 * kWidth_px,
                   DepthFormat::kFloat32, 0.001F};
    frame.camera = {150.0F, 150.0F, 80.0F, 60.0F};
    frame.stamp_ns = 33'000'000 * ++frames_;
    if (masked) frame.mask = {labels_.data(), kWidth_px, kHeight_px, kWidth_px};
    object().Track(frame, {}, result_);
    const Estimate& estimate = result_.estimate;
    return estimate.status == Status::kOk ? estimate.T_co.translation().z() : 0.0F;
  }

  TrackedObject& object() {
    if (!object_) object_ = MakeTrackedObject(ProfileName::kMicro, options_);
    return *object_;
  }

  static ObjectChoice RightThing() {
    ObjectChoice choice;
    choice.u = kRightMiddle;
    choice.v = 0.5F;
    return choice;
  }

  static constexpr std::size_t kPixels = kWidth_px * kHeight_px;
  std::vector<float> depth_m_;
  std::vector<float> shown_m_;
  std::vector<std::uint8_t> labels_;
  ObjectOptions options_;
  std::unique_ptr<TrackedObject> object_;
  FrameResult result_;
  std::int64_t frames_ = 0;
};

TEST_F(TrackedObjectTest, ChosenThing_IsTrackedInTheNextFrame) {
  EXPECT_NEAR(TrackNext(), kLeft_m, 0.01F);
  object().channel().Choose(RightThing());
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(TrackNext(), kRight_m, 0.01F);
  EXPECT_EQ(result_.estimate.reset_counter, 1);
}

TEST_F(TrackedObjectTest, OfSeveralChoices_TheLastCounts) {
  ObjectChoice left = RightThing();
  left.u = 0.25F;
  object().channel().Choose(left);
  object().channel().Choose(RightThing());
  EXPECT_NEAR(TrackNext(), kRight_m, 0.01F);
}

TEST_F(TrackedObjectTest, ChoiceOutsideOfTheImage_LosesNothing) {
  EXPECT_NEAR(TrackNext(), kLeft_m, 0.01F);
  ObjectChoice wrong = RightThing();
  wrong.u = 1.5F;
  object().channel().Choose(wrong);
  EXPECT_NEAR(TrackNext(), kLeft_m, 0.01F);
  EXPECT_EQ(result_.estimate.reset_counter, 0);
}

TEST_F(TrackedObjectTest, MaskThatIsChosen_HoldsUntilWhatItShowsWasSeen) {
  EXPECT_NEAR(TrackNext(), kLeft_m, 0.01F);
  ObjectChoice choice;
  choice.kind = ObjectChoice::Kind::kMask;
  choice.mask_width_px = kWidth_px;
  choice.mask_height_px = kHeight_px;
  choice.mask.resize(kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) choice.mask[i] = labels_[i] == 2 ? 255 : 0;
  // Nothing can be seen of it at first.
  const std::vector<float> depth_m = depth_m_;
  depth_m_.assign(kPixels, 0.0F);
  object().channel().Choose(choice);
  EXPECT_EQ(TrackNext(), 0.0F);
  // What lies in no image does not take its place meanwhile.
  ObjectChoice wrong = choice;
  wrong.mask.pop_back();
  object().channel().Choose(wrong);
  EXPECT_EQ(TrackNext(), 0.0F);
  EXPECT_NE(result_.estimate.status, Status::kMaskSizeMismatch);
  depth_m_ = depth_m;
  EXPECT_NEAR(TrackNext(), kRight_m, 0.01F);
  // The mask is no guide any more: the thing may leave its place in it.
  Draw(95, 140, kWall_m, 0);
  Draw(88, 133, kRight_m, 2);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(TrackNext(), kRight_m, 0.01F);
  EXPECT_LT(result_.estimate.T_co.translation().x(), 0.165F);
}

TEST_F(TrackedObjectTest, WithLabels_TheOneUnderThePlaceIsTracked) {
  options_.label = 1;
  EXPECT_NEAR(TrackNext(true), kLeft_m, 0.01F);
  object().channel().Choose(RightThing());
  EXPECT_NEAR(TrackNext(true), kRight_m, 0.01F);
  EXPECT_EQ(result_.estimate.reset_counter, 1);
}

TEST_F(TrackedObjectTest, WithoutAMaskInTheFrame_MasksAreLeftAside) {
  options_.label = 1;
  EXPECT_NEAR(TrackNext(true), kLeft_m, 0.01F);
  object().channel().Choose(RightThing());
  EXPECT_NEAR(TrackNext(false), kRight_m, 0.01F);
  EXPECT_NEAR(TrackNext(true), kRight_m, 0.01F);
}

}  // namespace
}  // namespace disflow::apps
