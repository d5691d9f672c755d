// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/plane_removal.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <random>

#include "depth_scene.h"

namespace disflow {
namespace {

using testing::Covers;
using testing::DepthScene;

constexpr PixelBox kObject{60, 40, 100, 80};

class PlaneRemovalTest : public ::testing::Test {
 protected:
  void Find(const DepthScene& scene, const PixelBox& box = DepthScene::image()) {
    const DepthReader depth(scene.frame().depth, 0.1F, 10.0F);
    planes_->Find(depth, box, [](int, int, float) { return true; });
  }
  /// Share of the pixels inside (or outside) of a box that are taken away.
  [[nodiscard]] double RemovedShare(const DepthScene& scene, const PixelBox& box,
                                    bool inside) const {
    int all = 0;
    int removed = 0;
    for (int v = 0; v < DepthScene::kHeight_px; ++v) {
      std::array<float, DepthScene::kWidth_px> row;
      for (int u = 0; u < DepthScene::kWidth_px; ++u)
        row[static_cast<std::size_t>(u)] = scene.At(u, v);
      (*planes_)(v, 0, DepthScene::kWidth_px, row.data());
      for (int u = 0; u < DepthScene::kWidth_px; ++u) {
        if (Covers(box, u, v) != inside) continue;
        ++all;
        removed += row[static_cast<std::size_t>(u)] == 0.0F ? 1 : 0;
      }
    }
    return static_cast<double>(removed) / all;
  }
  std::unique_ptr<PlaneRemoval> planes_ = std::make_unique<PlaneRemoval>();
};

TEST_F(PlaneRemovalTest, WallAndTable_GoAndTheObjectStays) {
  DepthScene scene(2.2F);
  scene.Table().Rectangle(kObject, 0.8F);
  Find(scene);
  EXPECT_GT(RemovedShare(scene, kObject, false), 0.99);
  EXPECT_EQ(RemovedShare(scene, kObject, true), 0.0);
}

TEST_F(PlaneRemovalTest, SensorNoise_LeavesAlmostNothingOfThePlane) {
  DepthScene scene(2.2F);
  scene.Table();
  std::mt19937 random(4);
  std::normal_distribution<float> noise(0.0F, 0.003F);  // 1/m
  const DepthScene clean = scene;
  scene.Draw(DepthScene::image(),
             [&](int u, int v) { return 1.0F / (1.0F / clean.At(u, v) + noise(random)); });
  scene.Rectangle(kObject, 0.8F);
  Find(scene);
  EXPECT_GT(RemovedShare(scene, kObject, false), 0.98);
  EXPECT_EQ(RemovedShare(scene, kObject, true), 0.0);
}

// In inverse depth it is 0.016 1/m where the table is nearest.
TEST_F(PlaneRemovalTest, NoiseThatIsTheSameInDepth_LeavesAlmostNothingOfThePlaneWhereItIsNear) {
  constexpr int kNear_v = DepthScene::kHeight_px - 30;
  DepthScene scene(4.0F);
  scene.Draw(DepthScene::image(),
             [](int, int v) { return 1.0F / (0.6F + 0.009F * static_cast<float>(v)); });
  std::mt19937 random(4);
  std::normal_distribution<float> noise_m(0.0F, 0.0055F);
  const DepthScene clean = scene;
  scene.Draw(DepthScene::image(), [&](int u, int v) { return clean.At(u, v) + noise_m(random); });
  const PixelBox thing{60, kNear_v, 100, DepthScene::kHeight_px - 10};
  scene.Draw(thing, [&](int u, int v) { return clean.At(u, v) - 0.025F; });
  Find(scene);
  EXPECT_GT(RemovedShare(scene, thing, false), 0.98);
  EXPECT_EQ(RemovedShare(scene, thing, true), 0.0);
}

TEST_F(PlaneRemovalTest, FaceThatEndsWithinTheImage_IsNoPlane) {
  // Nothing but a large face: the rest has no depth.
  DepthScene scene(0.0F);
  const PixelBox face{30, 20, 130, 100};
  scene.Rectangle(face, 0.8F);
  Find(scene);
  EXPECT_TRUE(planes_->empty());
  EXPECT_EQ(RemovedShare(scene, face, true), 0.0);
}

TEST_F(PlaneRemovalTest, OnlyContext_MakesPlanes) {
  DepthScene scene(2.2F);
  const DepthReader depth(scene.frame().depth, 0.1F, 10.0F);
  planes_->Find(depth, DepthScene::image(), [](int, int, float) { return false; });
  EXPECT_TRUE(planes_->empty());
}

TEST_F(PlaneRemovalTest, Clear_ForgetsThePlanes) {
  DepthScene scene(2.2F);
  Find(scene);
  ASSERT_FALSE(planes_->empty());
  planes_->Clear();
  EXPECT_EQ(RemovedShare(scene, kObject, false), 0.0);
}

}  // namespace
}  // namespace disflow
