// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/model_gate.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "depth_scene.h"

namespace disflow {
namespace {

using testing::Covers;
using testing::DepthScene;

constexpr float kMargin_m = 0.02F;

ModelPrior Prior() {
  ModelPrior prior;
  prior.known = true;
  Vec6 xi;
  xi << 0.05F, -0.03F, 0.0F, 0.3F, -0.5F, 0.2F;
  prior.T_oc =
      PoseCameraFromObject(ExpSo3(Vec3(xi.tail<3>())), Vec3(0.05F, -0.03F, 0.7F)).Inverse();
  prior.box_min_m = Vec3(-0.04F, -0.06F, -0.03F);
  prior.box_max_m = Vec3(0.05F, 0.07F, 0.06F);
  return prior;
}

bool IsNearBounds(const ModelPrior& prior, const Vec3& x_c) {
  const Vec3 x_o = prior.T_oc * x_c;
  return ((x_o - prior.box_min_m).array() >= -kMargin_m).all() &&
         ((prior.box_max_m - x_o).array() >= -kMargin_m).all();
}

TEST(ModelGate, PointsOfTheBoundsAndTheMargin_AreAccepted) {
  const ModelPrior prior = Prior();
  const PinholeCamera camera = DepthScene::camera();
  const ModelGate gate(camera, prior, kMargin_m);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-0.15F, 0.15F);
  int accepted = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 x_c = prior.T_oc.Inverse() * Vec3(uniform(random), uniform(random), uniform(random));
    ASSERT_EQ(gate.Accepts(x_c), IsNearBounds(prior, x_c)) << x_c.transpose();
    accepted += gate.Accepts(x_c) ? 1 : 0;
  }
  EXPECT_GT(accepted, 100);
  EXPECT_LT(accepted, 4900);
}

/// Of rows of 100 pixels. @return How many were accepted.
template <class Depth>
int ExpectTheSameAsPointByPoint(Depth&& depth) {
  const ModelPrior prior = Prior();
  const PinholeCamera camera = DepthScene::camera();
  const ModelGate gate(camera, prior, kMargin_m);
  int kept = 0;
  for (int v = 0; v < DepthScene::kHeight_px; ++v) {
    std::array<float, 100> row;
    std::array<float, 100> gated;
    for (std::size_t i = 0; i < row.size(); ++i) gated[i] = row[i] = depth(static_cast<int>(i), v);
    gate(v, 30, 130, gated.data());
    for (std::size_t i = 0; i < row.size(); ++i) {
      const Vec3 x_c =
          camera.BackProject(30.0F + static_cast<float>(i), static_cast<float>(v), row[i]);
      const Vec3 x_o = prior.T_oc * x_c;
      const Vec3 over = (x_o - prior.box_max_m).cwiseMax(prior.box_min_m - x_o);
      if (std::abs(over.maxCoeff() - kMargin_m) < 1e-5F) continue;  // on the very border
      EXPECT_EQ(gated[i], gate.Accepts(x_c) ? row[i] : 0.0F) << i << ' ' << v;
      kept += gated[i] > 0.0F ? 1 : 0;
    }
  }
  return kept;
}

TEST(ModelGate, ARowAtOnce_IsTheSameAsPointByPoint) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> depth(0.55F, 0.85F);
  EXPECT_GT(ExpectTheSameAsPointByPoint([&](int, int) { return depth(random); }), 100);
}

TEST(ModelGate, SmoothSurface_IsTheSameAsPointByPoint) {
  std::mt19937 random(3);
  std::bernoulli_distribution hole(0.02);
  for (const float depth_m : {0.3F, 0.62F, 0.7F, 0.78F, 1.5F}) {
    for (const bool holes : {false, true}) {
      const int kept = ExpectTheSameAsPointByPoint([&](int i, int v) {
        if (holes && hole(random)) return 0.0F;
        return depth_m + 1e-4F * static_cast<float>(i) + 2e-4F * static_cast<float>(v);
      });
      EXPECT_EQ(kept > 100, depth_m > 0.5F && depth_m < 1.0F) << depth_m;
    }
  }
}

TEST(ModelGate, SearchBox_HoldsEveryAcceptedPixel) {
  const ModelPrior prior = Prior();
  const PinholeCamera camera = DepthScene::camera();
  const ModelGate gate(camera, prior, kMargin_m);
  const PixelBox box = gate.SearchBox(0.1F, DepthScene::image());
  EXPECT_LT(box.width() * box.height(), DepthScene::kWidth_px * DepthScene::kHeight_px / 2);
  for (int v = 0; v < DepthScene::kHeight_px; ++v) {
    for (int u = 0; u < DepthScene::kWidth_px; ++u) {
      for (float z = 0.5F; z < 0.9F; z += 0.02F) {
        const Vec3 x_c = camera.BackProject(static_cast<float>(u), static_cast<float>(v), z);
        if (gate.Accepts(x_c)) {
          ASSERT_TRUE(Covers(box, u, v)) << u << ' ' << v;
        }
      }
    }
  }
}

TEST(ModelGate, ObjectAtTheCamera_IsSearchedEverywhere) {
  ModelPrior prior = Prior();
  prior.T_oc = PoseCameraFromObject(Mat3::Identity(), Vec3(0.0F, 0.0F, 0.05F)).Inverse();
  const PinholeCamera camera = DepthScene::camera();
  const PixelBox box = ModelGate(camera, prior, kMargin_m).SearchBox(0.1F, DepthScene::image());
  EXPECT_EQ(box.width(), DepthScene::kWidth_px);
  EXPECT_EQ(box.height(), DepthScene::kHeight_px);
}

TEST(ModelGate, CornerInTheCamerasOwnPlane_IsSearchedForInTheWholeImage) {
  ModelPrior prior;
  prior.known = true;
  const PinholeCamera camera = DepthScene::camera();
  for (const float nearest_z_m : {0.0F, -0.0F, 1e-38F, 1e-30F}) {
    // With x = 0 too the corner's pixel is 0 / 0.
    prior.box_min_m = Vec3(0.0F, -0.05F, nearest_z_m);
    prior.box_max_m = Vec3(0.1F, 0.05F, 0.2F);
    const PixelBox box = ModelGate(camera, prior, 0.0F).SearchBox(0.0F, DepthScene::image());
    EXPECT_EQ(box.u_min, 0);
    EXPECT_EQ(box.v_min, 0);
    EXPECT_EQ(box.u_max, DepthScene::kWidth_px);
    EXPECT_EQ(box.v_max, DepthScene::kHeight_px);
  }
}

}  // namespace
}  // namespace disflow
