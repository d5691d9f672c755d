// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"

/// @file
/// Masks, images and stamps that are not what they should be.

namespace disflow::host {
namespace {

constexpr int kWidth_px = 320;
constexpr int kHeight_px = 180;

SimulationOptions Small() {
  SimulationOptions options;
  options.motion = MotionKind::kFast;
  options.frames = 200;
  options.width_px = kWidth_px;
  options.height_px = kHeight_px;
  return options;
}

struct Shot {
  std::vector<std::uint8_t> exact;
  std::vector<std::uint8_t> mask;  ///< Empty if the frame brings none.
  std::vector<float> depth_m;
  StampNs stamp_ns = 0;
};

Shot Take(const SimulationOptions& options, int index) {
  Simulation simulation(options, MakeObjectMesh(options.object));
  DepthFrame frame;
  simulation.Render(index, frame);
  Shot shot;
  constexpr int kPixels = kWidth_px * kHeight_px;
  shot.exact.assign(simulation.gt_mask().data, simulation.gt_mask().data + kPixels);
  if (frame.mask.given()) shot.mask.assign(frame.mask.data, frame.mask.data + kPixels);
  shot.depth_m.resize(kPixels);
  std::memcpy(shot.depth_m.data(), frame.depth.data, kPixels * sizeof(float));
  shot.stamp_ns = frame.stamp_ns;
  return shot;
}

std::ptrdiff_t Size(const std::vector<std::uint8_t>& mask) {
  return std::count(mask.begin(), mask.end(), 255);
}

/// Whether all of `a` is in `b`.
bool IsWithin(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](std::uint8_t in_a, std::uint8_t in_b) { return in_a <= in_b; });
}

TEST(BlankTime, OfAnyMask_HasNeitherDepthNorMaskAndEndsAsIfItHadNotBeen) {
  constexpr int kFirst = 45;  // 1.5 s
  constexpr int kBack = kFirst + 15;
  SimulationOptions options = Small();
  options.blank_at_s = 1.5;
  for (const int grow_px : {0, 4}) {
    options.mask_grow_px = grow_px;
    options.blank_s = 0.0;
    const std::vector<Shot> seen = {Take(options, kFirst - 1), Take(options, kBack)};
    options.blank_s = 0.5;
    EXPECT_EQ(Take(options, kFirst - 1).depth_m, seen.front().depth_m);
    for (const int index : {kFirst, kBack - 1}) {
      const Shot blank = Take(options, index);
      EXPECT_EQ(std::count(blank.depth_m.begin(), blank.depth_m.end(), 0.0F),
                kWidth_px * kHeight_px);
      ASSERT_FALSE(blank.mask.empty());
      EXPECT_EQ(Size(blank.mask), 0) << index;
      EXPECT_EQ(Size(blank.exact), 0) << index;
    }
    EXPECT_EQ(Take(options, kBack).depth_m, seen.back().depth_m);
    EXPECT_EQ(Take(options, kBack).mask, seen.back().mask);
  }
}

TEST(DisturbedMask, Delayed_IsThatOfTheFrameBefore) {
  SimulationOptions options = Small();
  options.mask_delay = 2;
  EXPECT_EQ(Take(options, 40).mask, Take(options, 38).exact);
  EXPECT_NE(Take(options, 40).mask, Take(options, 40).exact);
  EXPECT_EQ(Take(options, 1).mask, Take(options, 0).exact);
}

TEST(DisturbedMask, GrownAndShrunk_HoldTheExactOneBetweenThem) {
  SimulationOptions options = Small();
  options.mask_grow_px = 6;
  const Shot grown = Take(options, 20);
  options.mask_grow_px = -4;
  const Shot shrunk = Take(options, 20);
  EXPECT_TRUE(IsWithin(shrunk.mask, shrunk.exact));
  EXPECT_TRUE(IsWithin(grown.exact, grown.mask));
  EXPECT_GT(Size(grown.mask), Size(grown.exact));
  EXPECT_LT(Size(shrunk.mask), Size(shrunk.exact));
}

TEST(DisturbedMask, Leaking_TakesInAPieceBesideTheObject) {
  SimulationOptions options = Small();
  options.mask = MaskKind::kLeaking;
  for (const int index : {0, 50, 150}) {
    const Shot shot = Take(options, index);
    EXPECT_TRUE(IsWithin(shot.exact, shot.mask));
    const auto leaked = static_cast<double>(Size(shot.mask) - Size(shot.exact));
    EXPECT_GT(leaked, 0.03 * static_cast<double>(Size(shot.exact)));
    EXPECT_LT(leaked, 0.5 * static_cast<double>(Size(shot.exact)));
  }
}

TEST(DisturbedMask, Flickering_IsMissingOrCutInItsShareOfFrames) {
  SimulationOptions options = Small();
  options.mask_flicker = 0.3;
  Simulation simulation(options, MakeObjectMesh(options.object));
  int missing = 0;
  int cut = 0;
  for (int index = 0; index < options.frames; ++index) {
    DepthFrame frame;
    simulation.Render(index, frame);
    if (!frame.mask.given()) {
      ++missing;
      continue;
    }
    cut += std::memcmp(frame.mask.data, simulation.gt_mask().data, kWidth_px * kHeight_px) != 0;
  }
  EXPECT_NEAR(missing, 30, 14);
  EXPECT_NEAR(cut, 30, 14);
}

TEST(DisturbedStream, RepeatedImage_IsTheOneBeforeUnderANewStamp) {
  SimulationOptions options = Small();
  options.repeat = 0.2;
  options.noise = NoiseKind::kWhite;
  const Simulation simulation(options, MakeObjectMesh(options.object));
  int repeated = 0;
  for (int index = 1; index < options.frames; ++index) repeated += simulation.IsRepeated(index);
  EXPECT_NEAR(repeated, 40, 18);
  EXPECT_FALSE(simulation.IsRepeated(0));
  int index = 1;
  while (!simulation.IsRepeated(index)) ++index;
  const Shot first = Take(options, index - 1);
  const Shot again = Take(options, index);
  EXPECT_EQ(first.depth_m, again.depth_m);
  EXPECT_EQ(first.mask, again.mask);
  EXPECT_GT(again.stamp_ns, first.stamp_ns);
}

TEST(DisturbedStream, JitteringStamps_KeepTheirOrderAndStayNear) {
  SimulationOptions options = Small();
  options.jitter_ms = 5.0;
  const Simulation simulation(options, MakeObjectMesh(options.object));
  options.jitter_ms = 0.0;
  const Simulation regular(options, MakeObjectMesh(options.object));
  StampNs last_ns = 0;
  StampNs farthest_ns = 0;
  for (int index = 0; index < options.frames; ++index) {
    const StampNs stamp_ns = simulation.TruthAt(index).stamp_ns;
    EXPECT_GT(stamp_ns, last_ns);
    farthest_ns = std::max(farthest_ns, std::abs(stamp_ns - regular.TruthAt(index).stamp_ns));
    last_ns = stamp_ns;
  }
  EXPECT_LE(farthest_ns, 5'000'000);
  EXPECT_GT(farthest_ns, 4'000'000);
}

}  // namespace
}  // namespace disflow::host
