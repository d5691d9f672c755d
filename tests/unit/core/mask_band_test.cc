// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/mask_band.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "depth_scene.h"

namespace disflow {
namespace {

using testing::Covers;

using Mask = PixelMask<200, 100>;
constexpr PixelBox kGiven{60, 30, 131, 70};

std::unique_ptr<Mask> MakeMask(const PixelBox& box) {
  auto mask = std::make_unique<Mask>();
  mask->Start(200, 100);
  for (int v = box.v_min; v < box.v_max; ++v) mask->row(v).SetRun(box.u_min, box.u_max);
  mask->Finish();
  return mask;
}

PixelBox Grown(const PixelBox& box, int by_px) {
  return {box.u_min - by_px, box.v_min - by_px, box.u_max + by_px, box.v_max + by_px};
}

TEST(Dilate, ReachesAsFarAsItsRadiusInEveryDirectionAndNoFarther) {
  // Across the borders of words and of the image.
  for (const PixelBox& box : {kGiven, PixelBox{0, 0, 3, 2}, PixelBox{190, 95, 200, 100}}) {
    for (const int radius_px : {0, 1, 7, 64}) {
      const auto mask = MakeMask(box);
      Mask dilated;
      Dilate(*mask, radius_px, dilated);
      for (int v = 0; v < 100; ++v) {
        for (int u = 0; u < 200; ++u)
          ASSERT_EQ(dilated.Test(u, v), Covers(Grown(box, radius_px), u, v)) << u << ' ' << v;
      }
    }
  }
}

TEST(Dilate, EmptyMask_StaysEmpty) {
  const auto mask = MakeMask({0, 0, 0, 0});
  Mask dilated;
  Dilate(*mask, 5, dilated);
  EXPECT_EQ(dilated.count(), 0);
}

TEST(MaskBand, ToleranceIsTheSettingPlusTheMotionAndBounded) {
  SegmenterConfig config;
  config.mask_tolerance_px = 5;
  const auto mask = MakeMask(kGiven);
  MaskBand<Mask> band;
  band.Start(*mask, config, 0.0F);
  EXPECT_EQ(band.tolerance_px(), 5);
  band.Start(*mask, config, 7.4F);
  EXPECT_EQ(band.tolerance_px(), 12);
  band.Start(*mask, config, 1e9F);
  EXPECT_EQ(band.tolerance_px(), 64);
}

TEST(MaskBand, Restrict_TakesAwayWhatLiesBeyondTheTolerance) {
  SegmenterConfig config;
  config.mask_tolerance_px = 4;
  MaskBand<Mask> band;
  band.Start(*MakeMask(kGiven), config, 0.0F);
  const auto object = MakeMask({0, 0, 200, 100});
  band.Restrict(*object);
  object->Finish();
  const PixelBox allowed = Grown(kGiven, 4);
  EXPECT_EQ(object->count(), allowed.width() * allowed.height());
  EXPECT_TRUE(band.AllowedIn(allowed.v_min).Test(allowed.u_min));
  EXPECT_FALSE(band.AllowedIn(allowed.v_min).Test(allowed.u_min - 1));
}

/// A plate that faces the camera, in front of a wall, under a mask.
class OverrunTest : public ::testing::Test {
 protected:
  static constexpr int kTolerance_px = 6;
  using SceneMask = PixelMask<testing::DepthScene::kWidth_px, testing::DepthScene::kHeight_px>;

  OverrunTest() { config_.mask_tolerance_px = kTolerance_px; }

  /// @param masked Box of the mask. @param plate Box of the surface.
  void Look(const PixelBox& masked, const PixelBox& plate) {
    scene_.Rectangle(plate, 1.0F);
    SceneMask given;
    given.Start(testing::DepthScene::kWidth_px, testing::DepthScene::kHeight_px);
    for (int v = masked.v_min; v < masked.v_max; ++v)
      given.row(v).SetRun(masked.u_min, masked.u_max);
    given.Finish();
    MaskBand<SceneMask> band;
    band.Start(given, config_, 0.0F);
    overrun_.Start(testing::DepthScene::kWidth_px, testing::DepthScene::kHeight_px);
    band.FindOverrun(
        [&](const auto& visit) {
          for (int v = plate.v_min; v < plate.v_max; ++v) visit(v, plate.u_min, plate.u_max);
        },
        overrun_);
  }
  [[nodiscard]] bool IsReachedFrom(int u, int v) const {
    const DepthFrame frame = scene_.frame();
    return overrun_.IsReachedFrom(u, v, DepthReader(frame.depth, 0.1F, 10.0F), frame.camera);
  }

  SegmenterConfig config_;
  testing::DepthScene scene_;
  MaskOverrun<SceneMask> overrun_;
};

constexpr PixelBox kMasked{60, 30, 100, 70};

TEST_F(OverrunTest, SurfaceThatEndsWithinTheBand_HasNone) {
  for (const int grown_px : {0, kTolerance_px, -9}) {
    Look(kMasked, Grown(kMasked, grown_px));
    EXPECT_EQ(overrun_.pixels.count(), 0) << grown_px;
    EXPECT_FALSE(IsReachedFrom(80, 50));
  }
}

TEST_F(OverrunTest, SurfaceThatGoesOnBelow_IsUndecidedAcrossTheMasksOutline) {
  // As an object that stands on a table.
  Look(kMasked, {kMasked.u_min, kMasked.v_min, kMasked.u_max, 110});
  // The true outline lies within the tolerance of the given one.
  for (int v = kMasked.v_max - kTolerance_px; v < kMasked.v_max + kTolerance_px; ++v)
    EXPECT_TRUE(IsReachedFrom(80, v)) << v;
  EXPECT_FALSE(IsReachedFrom(80, kMasked.v_max - 2 * kTolerance_px));
  EXPECT_FALSE(IsReachedFrom(80, kMasked.v_min)) << "the other side ends in the air";
}

TEST_F(OverrunTest, SurfaceBehindAStepInDepth_DoesNotCount) {
  Look(kMasked, {kMasked.u_min, kMasked.v_min, kMasked.u_max, 110});
  const int v = kMasked.v_max - kTolerance_px;
  ASSERT_TRUE(IsReachedFrom(80, v));
  // What goes on below is now another thing, far behind.
  scene_.Rectangle({kMasked.u_min, kMasked.v_max, kMasked.u_max, 110}, 2.5F);
  EXPECT_FALSE(IsReachedFrom(80, v));
}

TEST_F(OverrunTest, PixelWithoutDepth_ReachesNothing) {
  Look(kMasked, {kMasked.u_min, kMasked.v_min, kMasked.u_max, 110});
  scene_.Rectangle({80, 66, 81, 67}, 0.0F);
  EXPECT_FALSE(IsReachedFrom(80, 66));
  EXPECT_FALSE(IsReachedFrom(-5, 400));
}

}  // namespace
}  // namespace disflow
