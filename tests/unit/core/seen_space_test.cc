// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <memory>

#include "depth_scene.h"
#include "disflow/depth/seen_space_impl.h"

namespace disflow {
namespace {

using testing::DepthScene;

constexpr PixelBox kObject{60, 40, 100, 80};
constexpr float kObject_m = 0.8F;
constexpr float kWall_m = 2.0F;
constexpr float kMargin_m = 0.012F;
constexpr int kViews = 3;

PoseObjectFromCamera Turned(float angle_rad) {
  const Vec3 center(0.0F, 0.0F, kObject_m);
  const Mat3 rotation = ExpSo3(Vec3(0.0F, angle_rad, 0.0F));
  return {rotation, Vec3(-(rotation * center))};
}

class SeenSpaceTest : public ::testing::Test {
 protected:
  void Add(const DepthScene& scene, float angle_rad = 0.0F) {
    seen_->Add(DepthReader(scene.frame().depth, 0.1F, 10.0F), DepthScene::camera(),
               Turned(angle_rad), kObject);
  }
  /// Of the point that a camera at that angle sees at a pixel.
  [[nodiscard]] bool IsFree(float u_px, float v_px, float depth_m, float angle_rad = 0.0F) const {
    return seen_->IsFree(Turned(angle_rad) * DepthScene::camera().BackProject(u_px, v_px, depth_m),
                         kMargin_m);
  }
  [[nodiscard]] static DepthScene Scene() {
    DepthScene scene(kWall_m);
    scene.Rectangle(kObject, kObject_m);
    return scene;
  }
  using Seen = SeenSpace<kViews, 48>;
  std::unique_ptr<Seen> seen_ = std::make_unique<Seen>();
};

TEST_F(SeenSpaceTest, NothingSeen_NothingIsFree) {
  seen_->Start();
  EXPECT_FALSE(IsFree(50.0F, 60.0F, kObject_m));
}

TEST_F(SeenSpaceTest, BesideTheObject_IsFreeInFrontOfTheWall) {
  seen_->Start();
  Add(Scene());
  EXPECT_TRUE(IsFree(53.0F, 60.0F, kObject_m));
  EXPECT_TRUE(IsFree(53.0F, 60.0F, 1.9F));
  EXPECT_FALSE(IsFree(53.0F, 60.0F, kWall_m));
}

TEST_F(SeenSpaceTest, TheObjectAndWhatIsBehindIt_AreNotFree) {
  seen_->Start();
  Add(Scene());
  for (float u = 60.0F; u < 100.0F; u += 1.0F) {
    EXPECT_FALSE(IsFree(u, 60.0F, kObject_m)) << u;  // up to the very outline
    EXPECT_FALSE(IsFree(u, 60.0F, kObject_m + 0.05F)) << u;
  }
  // What sticks out towards the camera would have been seen.
  EXPECT_TRUE(IsFree(80.0F, 60.0F, kObject_m - 0.05F));
  EXPECT_FALSE(IsFree(80.0F, 60.0F, kObject_m - 0.5F * kMargin_m));
}

TEST_F(SeenSpaceTest, BeyondTheView_NothingIsKnown) {
  seen_->Start();
  Add(Scene());
  EXPECT_FALSE(IsFree(20.0F, 60.0F, kObject_m));   // not remembered
  EXPECT_FALSE(IsFree(-50.0F, 60.0F, kObject_m));  // not in the image
  EXPECT_FALSE(IsFree(53.0F, 60.0F, -0.5F));       // behind the camera
}

TEST_F(SeenSpaceTest, PixelsWithoutDepth_AreUnknown) {
  seen_->Start();
  DepthScene scene(0.0F);
  scene.Rectangle(kObject, kObject_m);
  Add(scene);
  EXPECT_FALSE(IsFree(53.0F, 60.0F, kObject_m));
}

TEST_F(SeenSpaceTest, ThingInFrontOfTheBackground_HidesWhatIsBehindIt) {
  seen_->Start();
  DepthScene scene = Scene();
  scene.Rectangle({48, 40, 60, 80}, 0.6F);
  Add(scene);
  EXPECT_FALSE(IsFree(53.0F, 60.0F, kObject_m));
}

TEST_F(SeenSpaceTest, ViewsFromTheSameSide_AreOne) {
  seen_->Start();
  for (int i = 0; i < 5; ++i) Add(Scene(), 0.05F * static_cast<float>(i));
  EXPECT_EQ(seen_->views(), 1);
}

TEST_F(SeenSpaceTest, OldestView_GivesWay) {
  seen_->Start();
  Add(Scene(), 0.0F);
  // Seen from elsewhere there is nothing to be known.
  DepthScene blind(0.0F);
  for (int i = 1; i < kViews; ++i) Add(blind, 0.5F * static_cast<float>(i));
  EXPECT_EQ(seen_->views(), kViews);
  EXPECT_TRUE(IsFree(53.0F, 60.0F, kObject_m));
  Add(blind, 0.5F * kViews);
  EXPECT_EQ(seen_->views(), kViews);
  EXPECT_FALSE(IsFree(53.0F, 60.0F, kObject_m));
}

TEST_F(SeenSpaceTest, NewObject_StartsWithNothing) {
  seen_->Start();
  Add(Scene());
  seen_->Start();
  EXPECT_EQ(seen_->views(), 0);
  EXPECT_FALSE(IsFree(53.0F, 60.0F, kObject_m));
}

TEST_F(SeenSpaceTest, TurnedObject_TakesItsFreeSpaceAlong) {
  seen_->Start();
  Add(Scene());
  // A point beside the object, where it is seen after the object turned by 40 degrees.
  const Vec3 beside_o = Turned(0.0F) * DepthScene::camera().BackProject(53.0F, 60.0F, kObject_m);
  const Vec3 beside_c = Turned(0.7F).Inverse() * beside_o;
  const Vec2 px = DepthScene::camera().Project(beside_c);
  EXPECT_TRUE(IsFree(px.x(), px.y(), beside_c.z(), 0.7F));
}

}  // namespace
}  // namespace disflow
