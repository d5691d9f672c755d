// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "depth_scene.h"
#include "disflow/depth/valley_cut_impl.h"

namespace disflow {
namespace {

using testing::DepthScene;

constexpr PixelBox kImage{0, 0, DepthScene::kWidth_px, DepthScene::kHeight_px};
constexpr float kDistance_m = 0.5F;
constexpr int kFold_px = 80;

class ValleyCutTest : public ::testing::Test {
 protected:
  /// Which pixels of the box are cut.
  void Cut(const DepthScene& scene, const PixelBox& box = kImage) {
    const DepthFrame frame = scene.frame();
    const DepthReader depth(frame.depth, 0.1F, 10.0F);
    valleys_->Start(depth, frame.camera, box, kDistance_m);
    for (auto& row : cut_) row.fill(false);
    for (int v = box.v_min; v < box.v_max; ++v) CutRow(depth, v, box.u_min, box.u_max);
  }
  /// Of the image that the cut was started with.
  void CutRow(const DepthReader& depth, int v, int u_begin, int u_end) {
    std::array<float, DepthScene::kWidth_px> row_m;
    depth.ReadRow(v, u_begin, u_end, row_m.data());
    const auto before_m = row_m;
    (*valleys_)(depth, v, u_begin, u_end, row_m.data());
    for (int u = u_begin; u < u_end; ++u) {
      const auto i = static_cast<std::size_t>(u - u_begin);
      cut_[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)] =
          before_m[i] > 0.0F && row_m[i] <= 0.0F;
      if (row_m[i] > 0.0F) {
        EXPECT_EQ(row_m[i], before_m[i]);
      }
    }
  }
  [[nodiscard]] bool IsCut(int u, int v) const {
    return cut_[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)];
  }
  [[nodiscard]] int Count() const {
    int count = 0;
    for (const auto& row : cut_)
      count += static_cast<int>(std::count(row.begin(), row.end(), true));
    return count;
  }

  using Picture = std::array<std::array<bool, DepthScene::kWidth_px>, DepthScene::kHeight_px>;
  std::unique_ptr<ValleyCut<DepthScene::kWidth_px>> valleys_ =
      std::make_unique<ValleyCut<DepthScene::kWidth_px>>();
  Picture cut_{};
};

/// Two planes that meet in column kFold_px, or row if `across`.
/// @param fold Between their slopes, m/m; > 0: towards the camera.
DepthScene Folded(float fold, bool across = false, float noise_per_m = 0.0F) {
  DepthScene scene;
  const float w = 1.0F / kDistance_m;
  const float slope = 0.5F * fold * w / DepthScene::kFocal_px;
  std::minstd_rand random(5);
  std::normal_distribution<float> normal(0.0F, 1.0F);
  scene.Draw(kImage, [&](int u, int v) {
    const int beside_px = std::abs(across ? v - kFold_px / 2 : u - kFold_px);
    return 1.0F / (w + slope * static_cast<float>(beside_px) + noise_per_m * normal(random));
  });
  return scene;
}

TEST_F(ValleyCutTest, Valley_IsCutAlongAllOfItsLength) {
  for (const bool across : {false, true}) {
    Cut(Folded(1.2F, across));
    const int length_px = across ? DepthScene::kWidth_px : DepthScene::kHeight_px;
    for (int i = 0; i < length_px; ++i)
      EXPECT_TRUE(across ? IsCut(i, kFold_px / 2) : IsCut(kFold_px, i)) << across << ", " << i;
  }
}

TEST_F(ValleyCutTest, WhatLiesBesideTheValley_IsNotCut) {
  Cut(Folded(1.2F));
  for (int v = 0; v < DepthScene::kHeight_px; ++v) {
    for (int u = 0; u < DepthScene::kWidth_px; ++u) {
      if (std::abs(u - kFold_px) > valleys_->reach_px() + 1) {
        EXPECT_FALSE(IsCut(u, v)) << u;
      }
    }
  }
}

TEST_F(ValleyCutTest, RidgesAndPlanesHoweverTilted_AreNotCut) {
  for (const float fold : {-2.0F, -1.2F, 0.0F}) {
    Cut(Folded(fold));
    EXPECT_EQ(Count(), 0) << fold;
  }
  DepthScene table(3.0F);
  Cut(table.Table());
  int cut = 0;
  for (int v = 40; v < DepthScene::kHeight_px; ++v) cut += IsCut(60, v) ? 1 : 0;
  EXPECT_EQ(cut, 0);
}

TEST_F(ValleyCutTest, ShallowFold_IsNotCut) {
  Cut(Folded(0.35F));
  EXPECT_EQ(Count(), 0);
}

TEST_F(ValleyCutTest, HollowAsLargeAsABowl_IsNotCut) {
  constexpr float kRadius_m = 0.05F;
  DepthScene scene(2.0F);
  scene.Draw({65, 45, 95, 75}, [](int u, int v) {
    const float x_m = static_cast<float>(u - 80) * kDistance_m / DepthScene::kFocal_px;
    const float y_m = static_cast<float>(v - 60) * kDistance_m / DepthScene::kFocal_px;
    return kDistance_m + std::sqrt(kRadius_m * kRadius_m - x_m * x_m - y_m * y_m) - kRadius_m;
  });
  Cut(scene, {73, 53, 87, 67});
  EXPECT_EQ(Count(), 0);
}

TEST_F(ValleyCutTest, NoiseOfAnySize_CutsNextToNothing) {
  for (const float noise_per_m : {0.0F, 0.003F, 0.01F, 0.03F}) {
    Cut(Folded(0.0F, false, noise_per_m));
    EXPECT_LE(Count(), kImage.width() * kImage.height() / 500) << noise_per_m;
  }
}

TEST_F(ValleyCutTest, ValleyAboveTheNoise_IsStillCut) {
  Cut(Folded(1.2F, false, 0.001F));
  int cut = 0;
  for (int v = 0; v < DepthScene::kHeight_px; ++v) cut += IsCut(kFold_px, v) ? 1 : 0;
  EXPECT_GT(cut, DepthScene::kHeight_px * 9 / 10);
}

TEST_F(ValleyCutTest, NearerThing_IsNotCutWhereItEnds) {
  constexpr PixelBox kThing{60, 40, 100, 80};
  DepthScene scene(1.0F);
  Cut(scene.Rectangle(kThing, kDistance_m));
  for (int v = kThing.v_min; v < kThing.v_max; ++v) {
    for (int u = kThing.u_min; u < kThing.u_max; ++u) EXPECT_FALSE(IsCut(u, v)) << u << ", " << v;
  }
}

TEST_F(ValleyCutTest, ImagesWithoutDepth_AreLeftAlone) {
  Cut(DepthScene(0.0F));
  EXPECT_EQ(Count(), 0);
  EXPECT_TRUE(valleys_->empty());
}

TEST_F(ValleyCutTest, BoxesOfAnyPlaceAndSize_AreReadWithinTheImage) {
  const DepthScene scene = Folded(1.2F);
  for (const PixelBox& box : {PixelBox{0, 0, 1, 1}, PixelBox{159, 119, 160, 120},
                              PixelBox{1, 3, 4, 120}, PixelBox{0, 118, 160, 120}}) {
    Cut(scene, box);
    for (int v = box.v_min; v < box.v_max; ++v) {
      for (int u = box.u_min; u < box.u_max; ++u) {
        if (std::abs(u - kFold_px) > 2 * ValleyCut<DepthScene::kWidth_px>().reach_px() + 20) {
          EXPECT_FALSE(IsCut(u, v));
        }
      }
    }
  }
}

/// Waves and noise that are cut here and there, in all rows.
DepthScene Crumpled(unsigned seed) {
  DepthScene scene;
  std::minstd_rand random(seed);
  std::normal_distribution<float> normal(0.0F, 0.001F);
  std::bernoulli_distribution lost(0.005);
  scene.Draw(kImage, [&](int u, int v) {
    const float a = std::abs(std::sin(static_cast<float>(u + 2 * v) / 17.0F));
    const float b = std::abs(std::sin(static_cast<float>(3 * v - u) / 23.0F));
    return lost(random) ? 0.0F : 1.0F / (1.9F + 0.25F * (a + b) + normal(random));
  });
  return scene;
}

/// The same, row by row, each by an object that has seen none before.
class ValleyCutRows : public ValleyCutTest {
 protected:
  void CutAfresh(const DepthScene& scene, const PixelBox& box) {
    const DepthFrame frame = scene.frame();
    const DepthReader depth(frame.depth, 0.1F, 10.0F);
    for (auto& row : cut_) row.fill(false);
    for (int v = box.v_min; v < box.v_max; ++v) {
      valleys_ = std::make_unique<ValleyCut<DepthScene::kWidth_px>>();
      valleys_->Start(depth, frame.camera, box, kDistance_m);
      CutRow(depth, v, box.u_min, box.u_max);
    }
  }
};

TEST_F(ValleyCutRows, OneAfterTheOther_AreCutAsEachAlone) {
  for (const PixelBox& box : {kImage, PixelBox{13, 7, 102, 95}, PixelBox{40, 60, 160, 120}}) {
    const DepthScene scene = Crumpled(1);
    CutAfresh(scene, box);
    const Picture alone = cut_;
    EXPECT_GT(Count(), 300);
    Cut(Crumpled(2));  // what is held of an image before
    Cut(scene, box);
    EXPECT_EQ(cut_, alone);
  }
}

TEST_F(ValleyCutRows, InAnyOrderAndAgain_AreCutAsEachAlone) {
  const DepthScene scene = Crumpled(3);
  CutAfresh(scene, kImage);
  const Picture alone = cut_;
  const DepthFrame frame = scene.frame();
  const DepthReader depth(frame.depth, 0.1F, 10.0F);
  valleys_ = std::make_unique<ValleyCut<DepthScene::kWidth_px>>();
  valleys_->Start(depth, frame.camera, kImage, kDistance_m);
  std::minstd_rand random(4);
  std::uniform_int_distribution<int> any(0, DepthScene::kHeight_px - 1);
  for (int k = 0; k < 200; ++k) {
    // A few rows down, from anywhere.
    const int first = any(random);
    for (int v = first; v < std::min(first + k % 30, DepthScene::kHeight_px); ++v) {
      const auto row = static_cast<std::size_t>(v);
      CutRow(depth, v, 0, DepthScene::kWidth_px);
      ASSERT_EQ(cut_[row], alone[row]) << v;
    }
  }
}

// Other columns of a row may be asked for than those before.
TEST_F(ValleyCutRows, OfOtherColumns_AreCutAsInTheWholeImage) {
  const DepthScene scene = Crumpled(5);
  Cut(scene);
  const Picture whole = cut_;
  const DepthFrame frame = scene.frame();
  const DepthReader depth(frame.depth, 0.1F, 10.0F);
  for (int v = 0; v < DepthScene::kHeight_px; ++v) {
    const auto row = static_cast<std::size_t>(v);
    const int middle = (7 * v) % (DepthScene::kWidth_px - 1) + 1;
    cut_[row].fill(false);
    CutRow(depth, v, 0, middle);
    CutRow(depth, v, middle, DepthScene::kWidth_px);
    ASSERT_EQ(cut_[row], whole[row]) << v;
  }
}

// What was read is wiped out of the image: the row itself and what it was compared with below.
TEST_F(ValleyCutRows, FromTopToBottom_AreReadOnce) {
  DepthScene scene = Crumpled(6);
  const DepthScene intact = scene;
  Cut(scene);
  const Picture whole = cut_;
  const DepthFrame frame = scene.frame();
  const DepthReader depth(frame.depth, 0.1F, 10.0F);
  valleys_->Start(depth, frame.camera, kImage, kDistance_m);
  const int reach_px = valleys_->reach_px();
  for (int v = 0; v < DepthScene::kHeight_px; v += 2) {
    for (int k = v; k < v + 2; ++k) {
      std::array<float, DepthScene::kWidth_px> row_m;
      const DepthFrame unwiped = intact.frame();
      DepthReader(unwiped.depth, 0.1F, 10.0F).ReadRow(k, 0, DepthScene::kWidth_px, row_m.data());
      const auto before_m = row_m;
      (*valleys_)(depth, k, 0, DepthScene::kWidth_px, row_m.data());
      for (std::size_t u = 0; u < row_m.size(); ++u)
        ASSERT_EQ(before_m[u] != row_m[u], whole[static_cast<std::size_t>(k)][u]) << k;
    }
    for (const int read : {v, v + reach_px})
      scene.Rectangle(Common(kImage, {0, read, DepthScene::kWidth_px, read + 2}), 0.0F);
  }
}

}  // namespace
}  // namespace disflow
