// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "depth_scene.h"
#include "disflow/depth/segmenter_choice_impl.h"
#include "disflow/depth/segmenter_impl.h"
#include "disflow/limits.h"

namespace disflow {
namespace {

using testing::Covers;
using testing::DepthScene;

constexpr PixelBox kObject{60, 30, 100, 70};
constexpr float kObject_m = 0.8F;
constexpr PixelBox kOther{20, 30, 40, 60};

/// The object's front in the camera frame.
Vec3 Corner(int u, int v) {
  return DepthScene::camera().BackProject(static_cast<float>(u), static_cast<float>(v), kObject_m);
}

/// Before there is a model.
class FirstFrame : public ::testing::Test {
 protected:
  Status Segment(const DepthScene& scene) {
    const auto explains = [this](const Vec3& x_c) {
      ++asked_;
      return explains_(x_c);
    };
    return segmenter_->Segment(scene.frame(), config_, prior_, explains, *object_, overrun_,
                               counters_);
  }
  /// Of the pixels of a box, those that are the object.
  [[nodiscard]] double Share(const PixelBox& box) const {
    int inside = 0;
    for (int v = box.v_min; v < box.v_max; ++v)
      inside += object_->row(v).CountRun(box.u_min, box.u_max);
    return static_cast<double>(inside) / (box.width() * box.height());
  }
  void ExpectExactly(const PixelBox& box) const {
    EXPECT_EQ(Share(box), 1.0);
    EXPECT_EQ(object_->count(), box.width() * box.height());
  }

  SegmenterConfig config_;
  ModelPrior prior_;
  Counters counters_;
  bool (*explains_)(const Vec3&) = [](const Vec3&) { return false; };
  int asked_ = 0;
  using SegmenterType = Segmenter<profiles::Micro>;
  std::unique_ptr<SegmenterType> segmenter_ = std::make_unique<SegmenterType>();
  std::unique_ptr<SegmenterType::Mask> object_ = std::make_unique<SegmenterType::Mask>();
  MaskOverrun<SegmenterType::Mask> overrun_;
};

DepthScene ObjectOverATable() {
  DepthScene scene(2.2F);
  scene.Table().Rectangle(kObject, kObject_m);
  return scene;
}

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

/// With a model: a plate as large as the object, in the predicted place.
class LaterFrame : public FirstFrame {
 protected:
  LaterFrame() {
    prior_.known = true;
    const Vec3 low = Corner(kObject.u_min, kObject.v_min);
    const Vec3 high = Corner(kObject.u_max, kObject.v_max);
    prior_.T_oc = PoseCameraFromObject(Mat3::Identity(), Vec3(0.5F * (low + high))).Inverse();
    prior_.box_max_m = 0.5F * (high - low) + Vec3(0.0F, 0.0F, 0.02F);
    prior_.box_min_m = -prior_.box_max_m;
    explains_ = [](const Vec3& x_c) {
      const Vec2 px = DepthScene::camera().Project(x_c);
      return Covers(kObject, static_cast<int>(px.x() + 0.5F), static_cast<int>(px.y() + 0.5F)) &&
             std::abs(x_c.z() - kObject_m) < 0.01F;
    };
  }
};

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
}  // namespace disflow
