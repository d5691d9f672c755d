// SPDX-License-Identifier: BSD-3-Clause
#include "segmenter_scene.h"

/// @file
/// Things that touch others, arms that hold them or reach into the image.

namespace disflow::testing {
namespace {

constexpr float kRise_px = 12.0F;

/// A board that lies in a heap, which rises about it and goes on out of the image, not as a plane.
/// @param slope Of the heap beside the board, m/m.
DepthScene ObjectInAHeap(float slope = 2.0F) {
  constexpr float kPixel_m = kObject_m / DepthScene::kFocal_px;
  DepthScene scene(2.2F);
  scene.Draw(DepthScene::image(), [slope](int u, int v) {
    const int beside_px = std::max(
        {kObject.u_min - u, u - kObject.u_max + 1, kObject.v_min - v, v - kObject.v_max + 1, 0});
    const float risen_px = std::min(static_cast<float>(beside_px), kRise_px);
    const float waves =
        std::sin(static_cast<float>(u) / 15.0F) * std::sin(static_cast<float>(v) / 13.0F);
    return kObject_m - slope * kPixel_m * risen_px + 0.02F * waves * (risen_px / kRise_px);
  });
  return scene;
}

TEST_F(FirstFrame, SeedOnAThingInAHeap_ChoosesTheThingAlone) {
  config_.seed_u_px = 80;
  config_.seed_v_px = 50;
  ASSERT_EQ(Segment(ObjectInAHeap()), Status::kOk);
  EXPECT_GT(Share({64, 34, 96, 66}), 0.95);
  EXPECT_LT(object_->count(), 1.1 * kObject.width() * kObject.height());
  EXPECT_TRUE(segmenter_->contact().touches);
}

TEST_F(FirstFrame, ThingInTheAir_TouchesNothing) {
  ASSERT_EQ(Segment(ObjectOverATable()), Status::kOk);
  EXPECT_FALSE(segmenter_->contact().touches);
}

TEST_F(LaterFrame, ObjectInAHeap_IsCutOffAndDecided) {
  for (const bool touched_before : {false, true}) {
    prior_.contact.touches = touched_before;
    ASSERT_EQ(Segment(ObjectInAHeap()), Status::kOk);
    EXPECT_GT(Share({64, 34, 96, 66}), 0.95);
    EXPECT_LT(object_->count(), 1.1 * kObject.width() * kObject.height());
    EXPECT_TRUE(segmenter_->contact().touches);
    EXPECT_FALSE(segmenter_->contact().merged);
  }
}

TEST_F(LaterFrame, ObjectThatPassesSmoothlyIntoAHeap_IsWhatTheModelKnowsAndMerged) {
  prior_.contact.touches = true;
  ASSERT_EQ(Segment(ObjectInAHeap(0.1F)), Status::kOk);
  EXPECT_GT(Share(kObject), 0.95);
  EXPECT_LT(object_->count(), 2 * kObject.width() * kObject.height());
  EXPECT_TRUE(segmenter_->contact().merged);
}

TEST_F(LaterFrame, ObjectThatLeftItsTable_TouchesNothingAnyMore) {
  prior_.contact.touches = true;
  ASSERT_EQ(Segment(ObjectOverATable()), Status::kOk);
  ExpectExactly(kObject);
  EXPECT_FALSE(segmenter_->contact().touches);
}

TEST_F(LaterFrame, ObjectThatMovedOutOfTheMargin_IsWhatLiesWithinItAndTouchesNothing) {
  constexpr int kShift_px = 11;
  const auto reach_px =
      static_cast<int>(config_.model_margin_m * DepthScene::kFocal_px / kObject_m);
  ASSERT_GT(kShift_px, reach_px);
  const PixelBox moved{kObject.u_min + kShift_px, kObject.v_min, kObject.u_max + kShift_px,
                       kObject.v_max};
  DepthScene scene(2.2F);
  ASSERT_EQ(Segment(scene.Rectangle(moved, kObject_m)), Status::kOk);
  EXPECT_EQ(Share({moved.u_min, moved.v_min, kObject.u_max + reach_px, moved.v_max}), 1.0);
  EXPECT_EQ(Share({kObject.u_max + reach_px + 2, moved.v_min, moved.u_max, moved.v_max}), 0.0);
  EXPECT_FALSE(segmenter_->contact().touches);
}

TEST_F(LaterFrame, NewFaceOfALargeObject_IsNoTableThatItStandsOn) {
  // It reaches 7 cm out of what is known: more than twice the margin, less than 0.6 of 0.15 m. Not
  // flat, or it would be taken away as a plane.
  DepthScene scene(2.2F);
  scene.Draw({kObject.u_min, kObject.v_min, kObject.u_max + 14, kObject.v_max}, [](int u, int v) {
    return kObject_m +
           0.02F * std::sin(static_cast<float>(u) / 7.0F) * std::sin(static_cast<float>(v) / 6.0F);
  });
  explains_ = [](const Vec3& x_c) {
    const Vec2 px = DepthScene::camera().Project(x_c);
    return Covers(kObject, static_cast<int>(px.x() + 0.5F), static_cast<int>(px.y() + 0.5F));
  };
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_EQ(Share(kObject), 1.0);
  EXPECT_FALSE(segmenter_->contact().touches);
  // Of a model of half the size it reaches out farther than such a thing is likely to be deep.
  prior_.box_max_m *= 0.5F;
  prior_.box_min_m *= 0.5F;
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_TRUE(segmenter_->contact().touches);
}

constexpr float kArm_m = 0.5F;

/// A forearm, thick as it is wide, that reaches in from one side of the image.
DepthScene& AddArm(DepthScene& scene, const PixelBox& box, float depth_m = kArm_m) {
  const bool upright = box.height() > box.width();
  return scene.Draw(box, [&, upright](int u, int v) {
    const float middle_px =
        0.5F * static_cast<float>(upright ? box.u_min + box.u_max : box.v_min + box.v_max);
    const float across_px = static_cast<float>(upright ? u : v) - middle_px;
    const float radius_px = 0.5F * static_cast<float>(std::min(box.width(), box.height()));
    return depth_m + 0.02F * across_px * across_px / (radius_px * radius_px);
  });
}

// From below, from above, from the left, from the right.
constexpr PixelBox kArms[] = {{110, 60, 130, DepthScene::kHeight_px},
                              {110, 0, 130, 60},
                              {0, 80, 70, 100},
                              {90, 80, DepthScene::kWidth_px, 100}};

TEST_F(FirstFrame, ArmThatReachesInAndIsNearer_IsNotTheObject) {
  for (const PixelBox& arm : kArms) {
    DepthScene scene(2.2F);
    scene.Rectangle(kObject, kObject_m);
    ASSERT_EQ(Segment(AddArm(scene, arm)), Status::kOk);
    EXPECT_EQ(Share(arm), 0.0) << arm.u_min << ", " << arm.v_min;
    ExpectExactly(kObject);
  }
}

TEST_F(FirstFrame, ArmThatIsCutJustBeforeTheBorder_IsNotTheObjectEither) {
  // Where noise or a sleeve makes a fold, which leaves a piece of the arm that ends in the image.
  constexpr int kFold_v = DepthScene::kHeight_px - 4;
  DepthScene scene(2.2F);
  scene.Rectangle(kObject, kObject_m);
  AddArm(scene, kArms[0]);
  scene.Draw({110, kFold_v, 130, DepthScene::kHeight_px},
             [](int, int v) { return kArm_m - 0.007F * static_cast<float>(v - kFold_v); });
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_EQ(Share(kArms[0]), 0.0);
  ExpectExactly(kObject);
}

TEST_F(FirstFrame, ThingThatReachesOutOfTheImage_IsTheObjectIfNothingElseCanBe) {
  for (const PixelBox& arm : kArms) {
    DepthScene scene(2.2F);
    scene.Rectangle({5, 5, 13, 14}, kObject_m);  // a crumb
    ASSERT_EQ(Segment(AddArm(scene, arm)), Status::kOk);
    EXPECT_GT(Share(arm), 0.9) << arm.u_min << ", " << arm.v_min;
    EXPECT_EQ(Share({5, 5, 13, 14}), 0.0);
  }
}

TEST_F(FirstFrame, RegionDrawnTooTightly_StillMeansTheNearestThingInIt) {
  DepthScene scene(2.2F);
  scene.Rectangle(kObject, kObject_m).Rectangle({110, 40, 125, 60}, 1.2F);
  config_.roi_x_px = kObject.u_min + 4;
  config_.roi_y_px = kObject.v_min + 4;
  config_.roi_width_px = 70;
  config_.roi_height_px = kObject.height() - 8;
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_GT(Share({kObject.u_min + 6, kObject.v_min + 6, kObject.u_max, kObject.v_max - 6}), 0.95);
  EXPECT_EQ(Share({110, 40, 125, 60}), 0.0);
}

TEST_F(FirstFrame, SeedOnAnArm_ChoosesIt) {
  config_.seed_u_px = 120;
  config_.seed_v_px = 90;
  DepthScene scene(2.2F);
  scene.Rectangle(kObject, kObject_m);
  ASSERT_EQ(Segment(AddArm(scene, kArms[0])), Status::kOk);
  EXPECT_GT(Share(kArms[0]), 0.9);
  EXPECT_EQ(Share(kObject), 0.0);
}

TEST_F(LaterFrame, ObjectHeldFromAnySide_TouchesWhatHoldsIt) {
  constexpr PixelBox kHolding[] = {{74, kObject.v_max, 86, DepthScene::kHeight_px},
                                   {74, 0, 86, kObject.v_min},
                                   {0, 44, kObject.u_min, 56},
                                   {kObject.u_max, 44, DepthScene::kWidth_px, 56}};
  for (const PixelBox& arm : kHolding) {
    DepthScene scene(2.2F);
    scene.Rectangle(kObject, kObject_m);
    ASSERT_EQ(Segment(AddArm(scene, arm, kObject_m - 0.02F)), Status::kOk);
    EXPECT_TRUE(segmenter_->contact().touches) << arm.u_min << ", " << arm.v_min;
    EXPECT_GT(Share(kObject), 0.95);
  }
}

TEST_F(LaterFrame, NewFaceOfAHeldObject_IsItsOwnIfItsTurnMayHaveBroughtItIntoView) {
  // Of what is cut off of the heap the model knows two thirds.
  explains_ = [](const Vec3& x_c) {
    constexpr int kKnown_px = kObject.u_min + 28;
    const Vec2 px = DepthScene::camera().Project(x_c);
    return px.x() < static_cast<float>(kKnown_px) && std::abs(x_c.z() - kObject_m) < 0.01F;
  };
  prior_.contact.touches = true;
  for (const float turned_rad : {0.0F, 0.05F}) {
    prior_.contact.turned_rad = turned_rad;
    ASSERT_EQ(Segment(ObjectInAHeap()), Status::kOk);
    EXPECT_TRUE(segmenter_->contact().merged);
    EXPECT_EQ(segmenter_->contact().turned_rad, turned_rad) << "it goes on to be counted";
  }
  prior_.contact.turned_rad = 0.5F;
  ASSERT_EQ(Segment(ObjectInAHeap()), Status::kOk);
  EXPECT_FALSE(segmenter_->contact().merged);
  EXPECT_EQ(segmenter_->contact().turned_rad, 0.0F) << "what is new is learnt from here on";
}

}  // namespace
}  // namespace disflow::testing
