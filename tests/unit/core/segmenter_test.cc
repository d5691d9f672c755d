// SPDX-License-Identifier: BSD-3-Clause
#include "segmenter_scene.h"

namespace disflow::testing {
namespace {

TEST_F(FirstFrame, NearestThing_IsTheObjectWithoutItsTable) {
  ASSERT_EQ(Segment(ObjectOverATable()), Status::kOk);
  ExpectExactly(kObject);
  EXPECT_EQ(asked_, 0);
}

TEST_F(FirstFrame, ObjectThatStandsOnTheTable_IsCutOff) {
  DepthScene scene(2.2F);
  scene.Table();
  const PixelBox standing{60, 40, 100, 90};
  // Its foot is where the table is; no jump of depth parts them.
  scene.Rectangle(standing, scene.At(80, 89));
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_GT(Share(standing), 0.9);
  EXPECT_LT(object_->count(), 1.02 * standing.width() * standing.height());
}

/// What noise leaves of a table: threads of two pixels that hang together.
DepthScene WithThreads(DepthScene scene, const PixelBox& box, float depth_m) {
  return scene.Draw(
      box, [&](int u, int v) { return v % 5 < 2 || u == box.u_min ? depth_m : scene.At(u, v); });
}

TEST_F(FirstFrame, ThreadsThatNoiseLeavesOfATable_AreNotTheObjectThoughTheyAreNearer) {
  const PixelBox threads{20, 85, 60, 110};
  ASSERT_EQ(Segment(WithThreads(ObjectOverATable(), threads, 0.6F)), Status::kOk);
  ExpectExactly(kObject);
}

TEST_F(FirstFrame, ThingOfThreads_IsTheObjectIfNothingElseIsThere) {
  const PixelBox threads{20, 85, 60, 110};
  ASSERT_EQ(Segment(WithThreads(DepthScene(0.0F), threads, 0.6F)), Status::kOk);
  EXPECT_GE(object_->count(), 10 * threads.width());
}

TEST_F(FirstFrame, RangeGate_LeavesOutWhatIsNearer) {
  DepthScene scene = ObjectOverATable();
  scene.Rectangle(kOther, 0.4F);
  config_.min_range_m = 0.5F;
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(kObject);
  config_.min_range_m = 0.2F;
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(kOther);
}

TEST_F(FirstFrame, RegionOfInterest_LeavesOutWhatIsOutside) {
  DepthScene scene = ObjectOverATable();
  scene.Rectangle(kOther, 0.4F);
  config_.roi_x_px = 45;
  config_.roi_y_px = 10;
  config_.roi_width_px = 80;
  config_.roi_height_px = 100;
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(kObject);
}

TEST_F(FirstFrame, SeedPixel_ChoosesTheThingUnderIt) {
  DepthScene scene = ObjectOverATable();
  scene.Rectangle(kOther, 0.4F);
  config_.seed_u_px = 80;
  config_.seed_v_px = 50;
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(kObject);
  config_.seed_u_px = 30;
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(kOther);
}

TEST_F(FirstFrame, SeedBesideEverything_FindsNothing) {
  config_.seed_u_px = 5;
  config_.seed_v_px = 5;
  EXPECT_EQ(Segment(ObjectOverATable()), Status::kNoValidDepth);
}

TEST_F(FirstFrame, SeedNearAThing_ChoosesItWithinItsReach) {
  config_.seed_u_px = kObject.u_max + 9;
  config_.seed_v_px = 50;
  config_.seed_reach_px = 9;
  EXPECT_EQ(Segment(ObjectOverATable()), Status::kNoValidDepth);
  config_.seed_reach_px = 10;
  ASSERT_EQ(Segment(ObjectOverATable()), Status::kOk);
  ExpectExactly(kObject);
}

TEST_F(FirstFrame, NothingButOnePlane_IsTheObject) {
  EXPECT_EQ(Segment(DepthScene(1.0F)), Status::kOk);
  EXPECT_GT(Share(DepthScene::image()), 0.99);
}

TEST_F(FirstFrame, RegionWithinTheThing_DoesNotTakeItsFaceForATable) {
  DepthScene scene = ObjectOverATable();
  constexpr PixelBox kKnob{74, 44, 86, 56};
  scene.Rectangle(kKnob, kObject_m - 0.01F);
  config_.roi_x_px = kObject.u_min + 4;
  config_.roi_y_px = kObject.v_min + 4;
  config_.roi_width_px = kObject.width() - 8;
  config_.roi_height_px = kObject.height() - 8;
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly({kObject.u_min + 4, kObject.v_min + 4, kObject.u_max - 4, kObject.v_max - 4});
}

TEST_F(FirstFrame, TableInTheRegion_IsCutOffAsInTheWholeImage) {
  config_.roi_x_px = 40;
  config_.roi_y_px = 20;
  config_.roi_width_px = 80;
  config_.roi_height_px = 80;
  ASSERT_EQ(Segment(ObjectOverATable()), Status::kOk);
  ExpectExactly(kObject);
}

TEST_F(FirstFrame, WithoutRegionGrowing_AllOfTheRegionIsTheObject) {
  config_.grow_region = 0;
  config_.roi_width_px = 50;
  config_.roi_height_px = 40;
  ASSERT_EQ(Segment(ObjectOverATable()), Status::kOk);
  ExpectExactly({0, 0, 50, 40});
}

TEST_F(FirstFrame, ExactMask_IsTakenAsItIs) {
  DepthScene scene = ObjectOverATable();
  scene.Mask(kObject);
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(kObject);
}

/// As a camera that matches windows of pixels leaves it in patches along an outline.
TEST_F(FirstFrame, BackgroundInsideAnExactMask_IsNotTheObject) {
  const PixelBox patch{kObject.u_min, kObject.v_min + 8, kObject.u_min + 6, kObject.v_min + 20};
  DepthScene scene(2.2F);
  scene.Rectangle(kObject, kObject_m).Rectangle(patch, 2.2F).Mask(kObject);
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_EQ(Share({patch.u_min, patch.v_min + 2, patch.u_max - 2, patch.v_max - 2}), 0.0);
  EXPECT_EQ(Share({patch.u_max, kObject.v_min, kObject.u_max, kObject.v_max}), 1.0);
}

/// From pixel to pixel its depth changes by 3 %: at 79 degrees, as it is still sampled.
TEST_F(FirstFrame, FaceSeenAtAGrazingAngleInACoarseImage_IsOneSurface) {
  const PixelBox face{70, 30, 86, 90};
  DepthScene scene(2.2F);
  scene.Draw(
      face, [&](int u, int) { return 0.7F * std::pow(1.03F, static_cast<float>(u - face.u_min)); });
  scene.Mask(face);
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(face);
}

TEST_F(FirstFrame, DilatedMask_LosesTheBackground) {
  DepthScene scene = ObjectOverATable();
  scene.Mask({kObject.u_min - 6, kObject.v_min - 6, kObject.u_max + 6, kObject.v_max + 6});
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(kObject);
}

/// A post that grows out of the table: one surface with it, without a step in depth.
DepthScene PostOnATable() {
  DepthScene scene(2.2F);
  scene.Table();
  const float foot_m = scene.At(80, 90);
  return scene.Rectangle({60, 30, 100, 90}, foot_m);
}

TEST_F(FirstFrame, MaskedObjectThatTouchesItsTable_IsWhatTheMaskCovers) {
  DepthScene scene = PostOnATable();
  scene.Mask({60, 30, 100, 90});
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly({60, 30, 100, 90});
}

TEST_F(FirstFrame, MaskedObjectThatTouchesItsTable_IsUndecidedAtItsFootAlone) {
  DepthScene scene = PostOnATable();
  scene.Mask({60, 30, 100, 90});
  const DepthFrame frame = scene.frame();
  const DepthReader depth(frame.depth, 0.1F, 10.0F);
  ASSERT_EQ(Segment(scene), Status::kOk);
  const auto undecided = [&](int u, int v) {
    return overrun_.IsReachedFrom(u, v, depth, frame.camera);
  };
  EXPECT_TRUE(undecided(80, 88));
  EXPECT_FALSE(undecided(80, 50));
}

TEST_F(FirstFrame, MaskedObjectInTheAir_IsDecidedEverywhere) {
  DepthScene scene(2.2F);
  scene.Rectangle(kObject, kObject_m).Mask(kObject);
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_EQ(overrun_.pixels.count(), 0);
}

TEST_F(FirstFrame, EmptyMask_IsRefused) {
  DepthScene scene = ObjectOverATable();
  scene.Mask({0, 0, 0, 0});
  EXPECT_EQ(Segment(scene), Status::kEmptyMask);
}

TEST_F(FirstFrame, NoDepth_IsRefused) {
  EXPECT_EQ(Segment(DepthScene(0.0F)), Status::kNoValidDepth);
}

TEST_F(LaterFrame, ObjectAlone_IsFoundWhereItIsPredicted) {
  ASSERT_EQ(Segment(ObjectOverATable()), Status::kOk);
  ExpectExactly(kObject);
}

TEST_F(LaterFrame, ThingFarFromTheModel_IsNotTheObject) {
  DepthScene scene = ObjectOverATable();
  scene.Rectangle(kOther, 0.4F);
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(kObject);
}

TEST_F(LaterFrame, ThingBesideTheModelAtAnotherDepth_IsNotTheObject) {
  DepthScene scene = ObjectOverATable();
  // Within the margin of the model, but nothing of it is known surface.
  scene.Rectangle({104, 30, 108, 70}, kObject_m - 0.02F);
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_EQ(Share(kObject), 1.0);
  EXPECT_EQ(Share({104, 30, 108, 70}), 0.0);
  EXPECT_GT(asked_, 0);
}

TEST_F(LaterFrame, DilatedMask_LosesTheBackground) {
  DepthScene scene = ObjectOverATable();
  scene.Mask({kObject.u_min - 6, kObject.v_min - 6, kObject.u_max + 6, kObject.v_max + 6});
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(kObject);
}

TEST_F(LaterFrame, ErodedMask_IsFilledUpFromTheModel) {
  DepthScene scene = ObjectOverATable();
  scene.Mask({kObject.u_min + 6, kObject.v_min + 6, kObject.u_max - 6, kObject.v_max - 6});
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_GT(Share(kObject), 0.9);
  EXPECT_LE(object_->count(), kObject.width() * kObject.height());
}

TEST_F(LaterFrame, MaskThatCameLate_IsCorrectedByTheModelAsFarAsTheObjectMoved) {
  DepthScene scene = ObjectOverATable();
  prior_.motion_px = 12.0F;
  scene.Mask({kObject.u_min - 12, kObject.v_min, kObject.u_max - 12, kObject.v_max});
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_GT(Share(kObject), 0.9);
  EXPECT_LE(object_->count(), kObject.width() * kObject.height());
}

TEST_F(LaterFrame, KnownSurfaceBeyondTheMasksTolerance_IsNotTheObject) {
  DepthScene scene = ObjectOverATable();
  constexpr int kMissing_px = 20;
  scene.Mask({kObject.u_min, kObject.v_min, kObject.u_max - kMissing_px, kObject.v_max});
  ASSERT_EQ(Segment(scene), Status::kOk);
  const int end_px = kObject.u_max - kMissing_px + config_.mask_tolerance_px;
  EXPECT_EQ(Share({end_px, kObject.v_min, kObject.u_max, kObject.v_max}), 0.0);
  EXPECT_GT(Share({kObject.u_min, kObject.v_min, end_px, kObject.v_max}), 0.9);
}

TEST_F(LaterFrame, TableThatTheModelAndTheMaskShare_IsNotFollowedBeyondTheTolerance) {
  // The model has learnt a piece of the table, which explains the next one.
  DepthScene scene = PostOnATable();
  explains_ = [](const Vec3&) { return true; };
  scene.Mask(kObject);
  prior_.box_max_m = Vec3::Constant(1.0F);
  prior_.box_min_m = -prior_.box_max_m;
  ASSERT_EQ(Segment(scene), Status::kOk);
  const int reach_px = config_.mask_tolerance_px;
  EXPECT_LE(object_->count(), (kObject.width() + 2 * reach_px) * (kObject.height() + 2 * reach_px));
  EXPECT_EQ(Share({0, 90, 160, 120}), 0.0);
}

TEST_F(LaterFrame, Doubt_WidensTheReach) {
  DepthScene scene(2.2F);
  // 6 cm beside the prediction: farther than model_margin_m, nearer than after two frames without
  // it.
  const int shift_px = static_cast<int>(0.06F * DepthScene::kFocal_px / kObject_m);
  scene.Rectangle(
      {kObject.u_min + shift_px, kObject.v_min, kObject.u_max + shift_px, kObject.v_max},
      kObject_m);
  const PixelBox far_edge{kObject.u_max + shift_px - 2, 45, kObject.u_max + shift_px, 55};
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_EQ(Share(far_edge), 0.0);
  prior_.doubtful = true;
  prior_.unseen_s = 0.067F;
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_EQ(Share(far_edge), 1.0);
}

TEST_F(LaterFrame, LongerTimeBetweenImages_WidensTheReachByWhatAVelocityMayChange) {
  DepthScene scene(2.2F);
  constexpr float kShift_m = 0.045F;
  const int shift_px = static_cast<int>(kShift_m * DepthScene::kFocal_px / kObject_m);
  scene.Rectangle(
      {kObject.u_min + shift_px, kObject.v_min, kObject.u_max + shift_px, kObject.v_max},
      kObject_m);
  const PixelBox far_edge{kObject.u_max + shift_px - 2, 45, kObject.u_max + shift_px, 55};
  prior_.unseen_s = 1.0F / 30.0F;
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_EQ(Share(far_edge), 0.0);
  prior_.unseen_s = 1.0F / 15.0F;
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_EQ(Share(far_edge), 1.0);
}

}  // namespace
}  // namespace disflow::testing
