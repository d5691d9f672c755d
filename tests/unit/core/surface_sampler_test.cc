// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/surface_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "disflow/depth/pixel_mask.h"
#include "disflow/depth/whole_windows_impl.h"
#include "disflow/limits.h"

namespace disflow::testing {
namespace {

/// As Edge, but with room for few samples and blocks.
struct Few : profiles::Edge {
  static constexpr int kMaxBlocks = 8192;
  static constexpr int kMaxSurfaceSamples = 64;
};

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr float kDepth_m = 0.8F;
const PinholeCamera kCamera{300.0F, 300.0F, 160.0F, 120.0F};

/// Samples the wanted pixels of a wall that faces the camera.
template <class Limits>
struct Wall {
  template <class IsWanted>
  explicit Wall(IsWanted&& wanted) {
    Sample(wanted);
  }
  template <class IsWanted>
  int Sample(IsWanted&& wanted) {
    auto mask = std::make_unique<PixelMask<kWidth, kHeight>>();
    mask->Start(kWidth, kHeight);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u)
        if (wanted(u, v)) mask->row(v).SetRun(u, u + 1);
    }
    mask->Finish();
    const DepthView view{depth_m.data(), kWidth, kHeight, 4 * kWidth, DepthFormat::kFloat32, 1.0F};
    const DepthReader reader(view, 0.1F, 10.0F);
    sampler->Sample(reader, kCamera, ErodedMask(*mask, 0), config, *samples, counters);
    return mask->count();
  }

  std::vector<float> depth_m =
      std::vector<float>(static_cast<std::size_t>(kWidth * kHeight), kDepth_m);
  SamplerConfig config;
  Counters counters;
  std::unique_ptr<SurfaceSampler<Limits>> sampler = std::make_unique<SurfaceSampler<Limits>>();
  std::unique_ptr<typename SurfaceSampler<Limits>::Samples> samples =
      std::make_unique<typename SurfaceSampler<Limits>::Samples>();
};

template <class Samples>
void ExpectOnWall(const Samples& samples) {
  for (const SurfaceSample& sample : samples) {
    EXPECT_NEAR(sample.position_m.z(), kDepth_m, 1e-5F);
    EXPECT_LT((sample.normal - Vec3(0.0F, 0.0F, -1.0F)).norm(), 1e-3F);
  }
}

TEST(SurfaceSampler, SurfaceAtAPixel_IsThatOfItsBlock) {
  const Wall<profiles::Edge> wall([](int u, int v) { return u > 50 && v > 40 && u < 250; });
  EXPECT_GT(wall.samples->size(), 1000);
  ExpectOnWall(*wall.samples);
  const auto surface = wall.sampler->SurfaceAt(100, 100);
  ASSERT_TRUE(surface.valid);
  EXPECT_NEAR(surface.offset_m, -kDepth_m, 1e-5F);
  EXPECT_LT((surface.normal - Vec3(0.0F, 0.0F, -1.0F)).norm(), 1e-3F);
}

TEST(SurfaceSampler, WhereThereAreNoPixels_IsNoSurface) {
  const Wall<profiles::Edge> wall(
      [](int u, int v) { return u < 250 && (u < 100 || u > 200 || v < 50); });
  EXPECT_FALSE(wall.sampler->SurfaceAt(150, 100).valid);
  EXPECT_FALSE(wall.sampler->SurfaceAt(300, 100).valid);
  EXPECT_FALSE(wall.sampler->SurfaceAt(-1, 0).valid);
}

TEST(SurfaceSampler, TooManyPixels_GiveLargerBlocksAndLoseNone) {
  const Wall<Few> wall([](int, int) { return true; });
  EXPECT_GT(wall.samples->size(), Few::kMaxSurfaceSamples / 2);
  EXPECT_EQ(wall.counters.samples_dropped, 0U);
  ExpectOnWall(*wall.samples);
}

TEST(SurfaceSampler, ScatteredPixels_FitIntoTheBlocksThereAre) {
  // Few pixels, but each in a block of its own if blocks were small.
  const Wall<Few> wall([](int u, int v) { return u % 8 == 0 && v % 8 == 0; });
  EXPECT_GT(wall.sampler->block_px(), 8);
  EXPECT_LE(wall.samples->size(), Few::kMaxSurfaceSamples);
}

TEST(SurfaceSampler, PixelsWithoutDepth_AreCountedOnceThoughBlocksGrow) {
  const auto scattered = [](int u, int v) { return u % 8 == 0 && v % 8 == 0; };
  Wall<Few> wall(scattered);
  EXPECT_EQ(wall.counters.pixels_out_of_range, 0U);
  std::fill(wall.depth_m.begin(), wall.depth_m.begin() + kWidth * kHeight / 2, 0.0F);
  const int pixels = wall.Sample(scattered);
  EXPECT_EQ(wall.counters.pixels_out_of_range, static_cast<std::uint32_t>(pixels / 2));
}

}  // namespace
}  // namespace disflow::testing
