// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/pixel_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include "depth_scene.h"
#include "disflow/depth/pixel_runs_impl.h"

namespace disflow {
namespace {

using testing::Covers;
using testing::DepthScene;
constexpr float kJump = 0.02F;
constexpr int kFewest_px = 30;
constexpr int kBridged_px = 3;

template <int kMaxRuns>
class Surfaces {
 public:
  explicit Surfaces(const DepthScene& scene, const PixelBox& box = DepthScene::image())
      : runs_(std::make_unique<Runs>()) {
    runs_->Build(
        DepthReader(scene.frame().depth, 0.1F, 10.0F), box, kJump, kFewest_px,
        [](int, int, int, float*) {}, kBridged_px);
  }
  [[nodiscard]] const auto& operator*() const { return *runs_; }
  [[nodiscard]] const auto* operator->() const { return runs_.get(); }
  /// Pixels in the runs of a component.
  [[nodiscard]] int Pixels(int component) const {
    int pixels = 0;
    runs_->ForEachRun(
        [&](int c, const PixelRun& run) { pixels += c == component ? run.length() : 0; });
    return pixels;
  }

 private:
  using Runs = PixelRuns<kMaxRuns, DepthScene::kWidth_px>;
  std::unique_ptr<Runs> runs_;
};

TEST(PixelRuns, ThingsAtOtherDepths_AreOtherSurfaces) {
  DepthScene scene(2.0F);
  scene.Rectangle({20, 20, 60, 50}, 1.0F).Rectangle({90, 60, 120, 100}, 0.7F);
  const Surfaces<2048> surfaces(scene);
  ASSERT_EQ(surfaces->components(), 3);
  const std::set<int> numbers{surfaces->ComponentAt(0, 0), surfaces->ComponentAt(30, 30),
                              surfaces->ComponentAt(100, 80)};
  EXPECT_EQ(numbers, (std::set<int>{0, 1, 2}));
  const int box = surfaces->ComponentAt(30, 30);
  EXPECT_EQ(surfaces->component(box).pixels, 40 * 30);
  EXPECT_EQ(surfaces.Pixels(box), 40 * 30);
  EXPECT_EQ(surfaces->first_run(box).v, 20);
  EXPECT_EQ(surfaces->first_run(box).u_begin, 20);
}

TEST(PixelRuns, SlantedSurface_IsOne) {
  DepthScene scene(3.0F);
  // From 0.8 m to 1.6 m over 100 pixels: below the jump from pixel to pixel.
  scene.Draw({30, 10, 130, 110},
             [](int u, int) { return 0.8F + 0.008F * static_cast<float>(u - 30); });
  const Surfaces<2048> surfaces(scene);
  EXPECT_EQ(surfaces->components(), 2);
  EXPECT_EQ(surfaces->ComponentAt(31, 60), surfaces->ComponentAt(128, 60));
}

TEST(PixelRuns, TwoArmsThatMeetBelow_AreOneSurface) {
  DepthScene scene(2.0F);
  scene.Rectangle({20, 10, 30, 80}, 1.0F).Rectangle({60, 10, 70, 80}, 1.0F);
  scene.Rectangle({20, 80, 70, 90}, 1.0F);
  const Surfaces<2048> surfaces(scene);
  EXPECT_EQ(surfaces->components(), 2);
  EXPECT_EQ(surfaces->ComponentAt(25, 12), surfaces->ComponentAt(65, 12));
  EXPECT_NE(surfaces->ComponentAt(45, 12), surfaces->ComponentAt(25, 12));
}

TEST(PixelRuns, LostPixels_DoNotCutASurface) {
  DepthScene scene(2.0F);
  scene.Rectangle({20, 20, 80, 60}, 1.0F).Rectangle({48, 20, 51, 60}, 0.0F);
  const Surfaces<2048> surfaces(scene);
  EXPECT_EQ(surfaces->ComponentAt(25, 40), surfaces->ComponentAt(75, 40));
  DepthScene split(2.0F);
  split.Rectangle({20, 20, 80, 60}, 1.0F).Rectangle({45, 20, 55, 60}, 0.0F);
  const Surfaces<2048> halves(split);
  EXPECT_NE(halves->ComponentAt(25, 40), halves->ComponentAt(75, 40));
}

TEST(PixelRuns, SmallSurfaces_AreNotRemembered) {
  DepthScene scene(2.0F);
  scene.Rectangle({20, 20, 25, 25}, 1.0F);
  const Surfaces<2048> surfaces(scene);
  EXPECT_EQ(surfaces->components(), 1);
  EXPECT_EQ(surfaces->ComponentAt(22, 22), (PixelRuns<2048, 160>::kNoComponent));
}

TEST(PixelRuns, OutOfMemory_IsCountedAndTheRestIsSound) {
  DepthScene scene(2.0F);
  scene.Rectangle({20, 20, 60, 50}, 1.0F);
  const Surfaces<100> surfaces(scene);
  EXPECT_GT(surfaces->dropped(), 0);
  EXPECT_EQ(surfaces->ComponentAt(30, 30) == surfaces->ComponentAt(0, 0), false);
  int last_v = 0;
  surfaces->ForEachRun([&](int, const PixelRun& run) { last_v = run.v; });
  EXPECT_LT(last_v, DepthScene::kHeight_px - 1);
}

/// A wall with a thing before its foot, whose pixels are at any depth every so often.
DepthScene NoisyScene(float share, std::uint32_t seed) {
  DepthScene scene(2.0F);
  scene.Rectangle({60, 80, 110, 110}, 1.0F);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
  scene.Draw(DepthScene::image(), [&](int u, int v) {
    const bool stays = uniform(random) > share;
    return stays ? scene.At(u, v) : 0.5F + 3.0F * uniform(random);
  });
  return scene;
}

template <class Runs>
int CountRuns(const Runs& runs) {
  int count = 0;
  runs.ForEachRun([&](int, const PixelRun&) { ++count; });
  return count;
}

/// Number of the surface of each pixel, row by row.
template <class Runs>
std::vector<int> Numbers(const Runs& runs) {
  std::vector<int> numbers(DepthScene::kWidth_px * DepthScene::kHeight_px, Runs::kNoComponent);
  runs.ForEachRun([&](int c, const PixelRun& run) {
    std::fill_n(numbers.begin() + run.v * DepthScene::kWidth_px + run.u_begin, run.length(), c);
  });
  return numbers;
}

TEST(PixelRuns, NoiseThatFillsTheMemory_TakesNoSurfaceAway) {
  for (const float share : {0.12F, 0.15F, 0.2F, 0.3F}) {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      const DepthScene scene = NoisyScene(share, seed);
      const Surfaces<19200> large(scene);
      const Surfaces<2048> small(scene);
      EXPECT_GT(CountRuns(*large), 2 * 2048);
      EXPECT_EQ(small->dropped(), 0) << share << ", " << seed;
      ASSERT_EQ(small->components(), large->components());
      const std::vector<int> in_large = Numbers(*large);
      const std::vector<int> in_small = Numbers(*small);
      // Each pixel of a surface is in the same one as with memory for all.
      std::set<std::pair<int, int>> pairs;
      std::set<int> found;
      for (std::size_t i = 0; i < in_large.size(); ++i) {
        if (in_large[i] == PixelRuns<19200, 160>::kNoComponent) continue;
        pairs.insert({in_large[i], in_small[i]});
        found.insert(in_small[i]);
      }
      const auto surfaces = static_cast<std::size_t>(large->components());
      EXPECT_EQ(pairs.size(), surfaces);
      EXPECT_EQ(found.size(), surfaces);
      EXPECT_EQ(found.count(PixelRuns<2048, 160>::kNoComponent), 0U);
    }
  }
}

TEST(PixelRuns, HolesThatFillTheMemory_AreBridgedButNotAcrossAnotherSurface) {
  // Ten holes in each row, ten pixels wide, so that the wall hangs together all around them.
  DepthScene scene(2.0F);
  scene.Draw(DepthScene::image(),
             [](int u, int v) { return (u + 5 * (v / 4)) % 16 < 10 && v % 4 < 3 ? 0.0F : 2.0F; });
  const PixelBox thing{72, 0, 82, DepthScene::kHeight_px};
  scene.Rectangle(thing, 1.0F);
  const Surfaces<19200> large(scene);
  ASSERT_GT(CountRuns(*large), 700);
  const Surfaces<700> surfaces(scene);
  EXPECT_EQ(surfaces->dropped(), 0);
  ASSERT_EQ(surfaces->components(), 3);  // the wall on either side of the thing
  const std::vector<int> numbers = Numbers(*surfaces);
  for (int v = 0; v < DepthScene::kHeight_px; ++v) {
    for (int u = thing.u_min; u < thing.u_max; ++u)
      ASSERT_EQ(numbers[static_cast<std::size_t>(v * DepthScene::kWidth_px + u)],
                surfaces->ComponentAt(75, 60));
  }
  EXPECT_EQ(surfaces->component(surfaces->ComponentAt(75, 60)).pixels,
            thing.width() * thing.height());
}

TEST(PixelRuns, NoiseThatFillsTheMemory_LeavesRunsInOrderThatDoNotOverlap) {
  for (const float share : {0.2F, 0.6F, 1.0F}) {
    const DepthScene scene = NoisyScene(share, 7);
    const Surfaces<700> surfaces(scene);
    std::vector<int> pixels(static_cast<std::size_t>(surfaces->components()));
    int v = 0;
    int u_end = 0;
    surfaces->ForEachRun([&](int c, const PixelRun& run) {
      if (run.v != v) u_end = 0;
      EXPECT_GE(run.v, v);
      EXPECT_GE(run.u_begin, u_end);
      EXPECT_GT(run.length(), 0);
      EXPECT_LE(run.u_end, DepthScene::kWidth_px);
      v = run.v;
      u_end = run.u_end;
      if (c != PixelRuns<700, 160>::kNoComponent)
        pixels[static_cast<std::size_t>(c)] += run.length();
    });
    for (int c = 0; c < surfaces->components(); ++c)
      EXPECT_EQ(surfaces->component(c).pixels, pixels[static_cast<std::size_t>(c)]);
  }
}

TEST(PixelRuns, FromBelow_TheSameRunsComeTheOtherWayRound) {
  DepthScene scene(2.0F);
  scene.Rectangle({20, 20, 60, 50}, 1.0F);
  const Surfaces<2048> surfaces(scene);
  std::vector<std::array<int, 3>> down;
  std::vector<std::array<int, 3>> up;
  const auto into = [](auto& list) {
    return [&list](int c, const PixelRun& run) { list.push_back({c, run.v, run.u_begin}); };
  };
  surfaces->ForEachRun(into(down));
  surfaces->ForEachRun(into(up), true);
  EXPECT_GT(down.size(), 120U);
  EXPECT_TRUE(std::equal(down.begin(), down.end(), up.rbegin(), up.rend()));
}

TEST(PixelRuns, WithAReach_TheNearestSurfaceWithinItIsFound) {
  DepthScene scene(0.0F);
  scene.Rectangle({20, 20, 60, 50}, 1.0F).Rectangle({90, 60, 120, 100}, 0.7F);
  const Surfaces<2048> surfaces(scene);
  const int left = surfaces->ComponentAt(40, 30);
  const int right = surfaces->ComponentAt(100, 80);
  ASSERT_NE(left, right);
  const int none = std::remove_cvref_t<decltype(*surfaces)>::kNoComponent;
  // Each side of a surface, 6 pixels from it.
  for (const auto& [u, v] : {std::pair{14, 30}, {65, 30}, {40, 14}, {40, 55}}) {
    EXPECT_EQ(surfaces->ComponentAt(u, v), none);
    EXPECT_EQ(surfaces->ComponentAt(u, v, 5), none) << u << ", " << v;
    EXPECT_EQ(surfaces->ComponentAt(u, v, 6), left) << u << ", " << v;
  }
  // A corner is farther off than its row and its column.
  EXPECT_EQ(surfaces->ComponentAt(63, 53, 5), none);
  EXPECT_EQ(surfaces->ComponentAt(63, 53, 6), left);
  EXPECT_EQ(surfaces->ComponentAt(70, 55, 100), left);
  EXPECT_EQ(surfaces->ComponentAt(80, 55, 100), right);
}

TEST(PixelRuns, OnlyTheBox_IsRead) {
  DepthScene scene(2.0F);
  scene.Rectangle({20, 20, 60, 50}, 1.0F);
  const PixelBox box{30, 25, 100, 90};
  const Surfaces<2048> surfaces(scene, box);
  surfaces->ForEachRun([&](int, const PixelRun& run) {
    EXPECT_TRUE(Covers(box, run.u_begin, run.v));
    EXPECT_TRUE(Covers(box, run.u_end - 1, run.v));
  });
  EXPECT_EQ(surfaces.Pixels(surfaces->ComponentAt(40, 30)), 30 * 25);
}

}  // namespace
}  // namespace disflow
