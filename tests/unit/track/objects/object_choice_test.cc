// SPDX-License-Identifier: BSD-3-Clause
#include "objects/object_choice.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace disflow::apps {
namespace {

constexpr int kWidth_px = 640;
constexpr int kHeight_px = 360;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

DepthFrame Frame() {
  DepthFrame frame;
  frame.depth.width_px = kWidth_px;
  frame.depth.height_px = kHeight_px;
  frame.camera = {400.0F, 400.0F, 320.0F, 180.0F};
  return frame;
}

ObjectChoice Pixel(float u, float v, float reach = 0.0F) {
  ObjectChoice choice;
  choice.u = u;
  choice.v = v;
  choice.reach = reach;
  return choice;
}

ObjectChoice Box(float u, float v, float width, float height) {
  ObjectChoice choice = Pixel(u, v);
  choice.kind = ObjectChoice::Kind::kBox;
  choice.width = width;
  choice.height = height;
  return choice;
}

ObjectChoice Point(const Vec3& point_m, bool in_world = false) {
  ObjectChoice choice;
  choice.kind = ObjectChoice::Kind::kPoint;
  choice.point_m = point_m;
  choice.in_world = in_world;
  return choice;
}

TEST(ObjectChoice, EveryPixelByItsMiddle_IsThatPixel) {
  for (int u = 0; u < kWidth_px; ++u) {
    for (const int v : {0, 1, 179, 180, 359}) {
      const auto start = StartIn(Frame(), Pixel((static_cast<float>(u) + 0.5F) / kWidth_px,
                                                (static_cast<float>(v) + 0.5F) / kHeight_px));
      ASSERT_TRUE(start.has_value());
      EXPECT_EQ(start->seed_u_px, u);
      EXPECT_EQ(start->seed_v_px, v);
      EXPECT_EQ(start->roi_width_px, 0);
    }
  }
}

TEST(ObjectChoice, FarEdgeOfTheImage_IsItsLastPixel) {
  const auto start = StartIn(Frame(), Pixel(1.0F, 1.0F, 0.1F));
  ASSERT_TRUE(start.has_value());
  EXPECT_EQ(start->seed_u_px, kWidth_px - 1);
  EXPECT_EQ(start->seed_v_px, kHeight_px - 1);
  EXPECT_EQ(start->seed_reach_px, 64);
}

TEST(ObjectChoice, Box_IsThatPartOfTheImage) {
  const auto start = StartIn(Frame(), Box(0.25F, 0.5F, 0.5F, 0.25F));
  ASSERT_TRUE(start.has_value());
  EXPECT_EQ(start->roi_x_px, 160);
  EXPECT_EQ(start->roi_y_px, 180);
  EXPECT_EQ(start->roi_width_px, 320);
  EXPECT_EQ(start->roi_height_px, 90);
  EXPECT_EQ(start->seed_u_px, -1);
}

TEST(ObjectChoice, PointInSpace_IsWhereTheCameraSeesIt) {
  const auto start = StartIn(Frame(), Point(Vec3(0.2F, -0.1F, 0.8F)));
  ASSERT_TRUE(start.has_value());
  EXPECT_EQ(start->seed_u_px, 420);
  EXPECT_EQ(start->seed_v_px, 130);
  EXPECT_EQ(start->seed_reach_px, 15);  // 3 cm at 0.8 m
}

TEST(ObjectChoice, PointInTheWorld_IsSeenFromWhereTheCameraIs) {
  DepthFrame frame = Frame();
  EXPECT_FALSE(StartIn(frame, Point(Vec3(1.0F, 2.0F, 3.8F), true)).has_value());
  frame.has_T_wc = true;
  frame.T_wc = Transform<World, Camera>(Mat3::Identity(), Vec3(0.8F, 2.1F, 3.0F));
  const auto start = StartIn(frame, Point(Vec3(1.0F, 2.0F, 3.8F), true));
  ASSERT_TRUE(start.has_value());
  EXPECT_EQ(start->seed_u_px, 420);
  EXPECT_EQ(start->seed_v_px, 130);
}

TEST(ObjectChoice, WhatLiesInNoImage_IsNone) {
  for (const float wrong : {-0.01F, 1.01F, 1e30F, kNan, std::numeric_limits<float>::infinity()}) {
    EXPECT_FALSE(StartIn(Frame(), Pixel(wrong, 0.5F)).has_value()) << wrong;
    EXPECT_FALSE(StartIn(Frame(), Pixel(0.5F, wrong)).has_value()) << wrong;
    EXPECT_FALSE(StartIn(Frame(), Pixel(0.5F, 0.5F, wrong)).has_value()) << wrong;
    EXPECT_FALSE(StartIn(Frame(), Box(wrong, 0.5F, 0.1F, 0.1F)).has_value()) << wrong;
  }
  for (const float wrong : {-0.1F, 0.0F, kNan})
    EXPECT_FALSE(StartIn(Frame(), Box(0.5F, 0.5F, wrong, 0.1F)).has_value()) << wrong;
  for (const Vec3& wrong : {Vec3(0.0F, 0.0F, -1.0F), Vec3(0.0F, 0.0F, 0.0F), Vec3(5.0F, 0.0F, 1.0F),
                            Vec3(kNan, 0.0F, 1.0F), Vec3(1e38F, 0.0F, 1e-38F)}) {
    EXPECT_FALSE(StartIn(Frame(), Point(wrong)).has_value()) << wrong.transpose();
  }
}

TEST(ObjectChoice, Mask_MustHaveTheImagesSize) {
  ObjectChoice choice;
  choice.kind = ObjectChoice::Kind::kMask;
  choice.mask.assign(std::size_t{kWidth_px} * kHeight_px, 255);
  choice.mask_width_px = kWidth_px;
  choice.mask_height_px = kHeight_px;
  EXPECT_TRUE(StartIn(Frame(), choice).has_value());
  choice.mask.pop_back();
  EXPECT_FALSE(StartIn(Frame(), choice).has_value());
  choice.mask.push_back(255);
  std::swap(choice.mask_width_px, choice.mask_height_px);
  EXPECT_FALSE(StartIn(Frame(), choice).has_value());
}

/// A frame whose mask shows 1 on its left and 2 on its right side, and nothing between.
class MaskedFrame {
 public:
  MaskedFrame() : pixels_(std::size_t{kWidth_px} * kHeight_px) {
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const std::size_t u = i % kWidth_px;
      pixels_[i] = u < 200 ? 1 : u < 400 ? 0 : 2;
    }
    frame_ = Frame();
    frame_.mask = {pixels_.data(), kWidth_px, kHeight_px, kWidth_px};
  }
  [[nodiscard]] ChosenMasks MasksOfPixel(int u, const ChosenMasks& before) const {
    ObjectStart start;
    start.seed_u_px = u;
    start.seed_v_px = 100;
    return MasksOf(frame_, start, before);
  }
  [[nodiscard]] const DepthFrame& frame() const { return frame_; }

 private:
  std::vector<std::uint8_t> pixels_;
  DepthFrame frame_;
};

TEST(ChosenMasks, LabelUnderThePlace_IsTheObjectsFromThenOn) {
  const MaskedFrame frame;
  const ChosenMasks right = frame.MasksOfPixel(500, {true, 1});
  EXPECT_TRUE(right.used);
  EXPECT_EQ(right.label, 2);
  ObjectStart box;
  box.roi_x_px = 50;
  box.roi_width_px = box.roi_height_px = 100;
  EXPECT_EQ(MasksOf(frame.frame(), box, right).label, 1);
}

TEST(ChosenMasks, MaskOfOneObjectWithoutLabels_StaysWithoutLabel) {
  const ChosenMasks chosen = MaskedFrame().MasksOfPixel(500, {true, 0});
  EXPECT_TRUE(chosen.used);
  EXPECT_EQ(chosen.label, 0);
}

TEST(ChosenMasks, PlaceThatNoMaskShows_LeavesTheMasksAside) {
  EXPECT_FALSE(MaskedFrame().MasksOfPixel(300, {true, 1}).used);
  DepthFrame unmasked = Frame();
  unmasked.mask.label = 1;
  const ChosenMasks none = MasksOf(unmasked, {}, {true, 1});
  EXPECT_FALSE(none.used);
  EXPECT_EQ(none.label, 0);
}

}  // namespace
}  // namespace disflow::apps
