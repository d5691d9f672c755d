// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/surface_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "disflow/depth/eroded_mask.h"
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

TEST(SurfaceSampler, WallThatFacesTheCamera_IsAsFarFromItsSamplesAsTheyReach) {
  for (const int edge_px : {2, 5, 9}) {
    Wall<profiles::Edge> wall([](int, int) { return false; });
    wall.config.min_block_px = wall.config.max_block_px = edge_px;
    const int edge = 10 * edge_px;
    wall.Sample([&](int u, int v) { return u < edge && v < edge; });
    ASSERT_EQ(wall.samples->size(), 100);
    float farthest_m = 0.0F;
    // Pixels are seen up to half of one beyond their middle.
    for (float v = -0.5F; v < static_cast<float>(edge); v += 0.5F) {
      for (float u = -0.5F; u < static_cast<float>(edge); u += 0.5F) {
        float nearest_m = 1e30F;
        for (const SurfaceSample& sample : *wall.samples)
          nearest_m =
              std::min(nearest_m, (kDepth_m * kCamera.Ray(u, v) - sample.position_m).norm());
        farthest_m = std::max(farthest_m, nearest_m);
      }
    }
    for (const SurfaceSample& sample : *wall.samples)
      EXPECT_NEAR(sample.reach_m, farthest_m, 1e-5F) << edge_px;
  }
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

/// Noise of inverse depth that neighbouring pixels share.
void AddCorrelatedNoise(float std_per_m, std::vector<float>& depth_m) {
  constexpr int kReach = 2;
  constexpr float kWindow = 2.0F * kReach + 1.0F;
  std::mt19937 random(5);
  std::normal_distribution<float> normal(0.0F, std_per_m * kWindow);
  std::vector<float> white(depth_m.size());
  for (float& value : white) value = normal(random);
  for (int v = kReach; v < kHeight - kReach; ++v) {
    for (int u = kReach; u < kWidth - kReach; ++u) {
      float sum = 0.0F;
      for (int dv = -kReach; dv <= kReach; ++dv) {
        for (int du = -kReach; du <= kReach; ++du)
          sum += white[static_cast<std::size_t>((v + dv) * kWidth + u + du)];
      }
      float& pixel_m = depth_m[static_cast<std::size_t>(v * kWidth + u)];
      pixel_m = 1.0F / (1.0F / pixel_m + sum / (kWindow * kWindow));
    }
  }
}

/// Root mean square of the tilt of the normals, per component [rad].
template <class Samples>
float TiltOf(const Samples& samples) {
  float sum = 0.0F;
  for (const SurfaceSample& sample : samples) sum += sample.normal.head<2>().squaredNorm();
  return std::sqrt(0.5F * sum / static_cast<float>(samples.size()));
}

TEST(SurfaceSampler, NoiseThatPixelsShare_WidensBlocksUntilNormalsAreAsSureAsWanted) {
  const auto wanted = [](int u, int v) { return u >= 50 && v >= 50 && u < 110 && v < 110; };
  Wall<profiles::Edge> wall(wanted);
  EXPECT_EQ(wall.sampler->block_px(), 2);  // nothing asks for more
  AddCorrelatedNoise(0.01F, wall.depth_m);
  wall.Sample(wanted);
  const float tilt_rad = TiltOf(*wall.samples);
  EXPECT_LT(tilt_rad, 1.5F * wall.config.normal_std_rad);
  EXPECT_GE(wall.samples->size(), 100);
  wall.config.normal_std_rad = 3.0F;
  wall.Sample(wanted);
  EXPECT_EQ(wall.sampler->block_px(), 2);
  EXPECT_GT(TiltOf(*wall.samples), 1.5F * tilt_rad);
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
