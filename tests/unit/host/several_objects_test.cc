// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"

namespace disflow::host {
namespace {

SimulationOptions Options(std::string_view names, int frames = 150) {
  SimulationOptions options;
  options.frames = frames;
  options.width_px = 320;
  options.height_px = 180;
  const hal::Fault fault = SetSimulationObject(names, options);
  EXPECT_TRUE(fault.ok()) << fault.message;
  return options;
}

Simulation Make(const SimulationOptions& options) {
  std::vector<TriangleMesh> meshes;
  for (const SimulatedShape& shape : ObjectShapes(options))
    meshes.push_back(MakeObjectMesh(shape.object));
  return {options, std::move(meshes)};
}

/// Pixels of every value of a mask.
std::array<int, 256> CountValues(const MaskView& mask) {
  std::array<int, 256> counts{};
  for (int v = 0; v < mask.height_px; ++v) {
    for (int u = 0; u < mask.width_px; ++u) ++counts[mask.row(v)[u]];
  }
  return counts;
}

TEST(SeveralObjects, Names_TellAllApart) {
  EXPECT_EQ(ObjectNames(Options("box+bottle+box+box")),
            (std::vector<std::string>{"box", "bottle", "box2", "box3"}));
  const SimulationOptions files = Options("obj:a+b.obj+can+obj:c.obj");
  EXPECT_EQ(files.obj_file, "a+b.obj") << "a + that no name follows is part of the file's name";
  EXPECT_EQ(ObjectNames(files), (std::vector<std::string>{"a+b", "can", "c"}));
}

TEST(SeveralObjects, WrongNames_LeaveTheOptionsAsTheyAre) {
  SimulationOptions options = Options("can");
  for (const char* names : {"box+", "box+cube", "+box", "box+box+box+box+box"}) {
    EXPECT_EQ(SetSimulationObject(names, options).status, Status::kInvalidUri) << names;
    EXPECT_EQ(ObjectNames(options), std::vector<std::string>{"can"});
  }
}

TEST(SeveralObjects, EachPixelOfALabel_LiesOnThatObject) {
  Simulation simulation = Make(Options("box+bottle+can", 60));
  for (const int index : {0, 30, 59}) {
    DepthFrame frame;
    simulation.Render(index, frame);
    for (int v = 0; v < frame.mask.height_px; ++v) {
      for (int u = 0; u < frame.mask.width_px; ++u) {
        const std::size_t label = frame.mask.row(v)[u];
        if (label == 0) continue;
        ASSERT_LE(label, simulation.objects());
        float depth_m = 0.0F;
        std::memcpy(&depth_m, frame.depth.row(v) + 4 * u, sizeof(depth_m));
        const Vec3 x_c =
            frame.camera.BackProject(static_cast<float>(u), static_cast<float>(v), depth_m);
        const Vec3d centre = simulation.TruthAt(index, label - 1).object.pose.translation();
        EXPECT_LT((x_c.cast<double>() - centre).norm(),
                  BoundingRadius(simulation.mesh(label - 1)) + 1e-3);
      }
    }
  }
}

TEST(SeveralObjects, AllAreSeenAtTheStart_AndPassBehindTheNearerOnes) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    SimulationOptions options = Options("box+bottle+box+bottle", 300);
    options.seed = seed;
    Simulation simulation = Make(options);
    std::array<int, 5> most{};
    std::array<int, 5> least{};
    least.fill(1 << 30);
    for (int index = 0; index < options.frames; index += 5) {
      DepthFrame frame;
      simulation.Render(index, frame);
      const std::array<int, 256> counts = CountValues(frame.mask);
      for (std::size_t label = 1; label <= 4; ++label) {
        EXPECT_TRUE(index > 0 || counts[label] > 100) << "seed " << seed << ", label " << label;
        most[label] = std::max(most[label], counts[label]);
        least[label] = std::min(least[label], counts[label]);
      }
    }
    EXPECT_GT(least[1], most[1] / 4) << "nothing is in front of the first";
    int hidden = 0;
    for (std::size_t label = 2; label <= 4; ++label) hidden += least[label] < most[label] / 2;
    EXPECT_GE(hidden, 2) << "seed " << seed;
  }
}

TEST(SeveralObjects, SpheresOfTwo_NeverTouch) {
  const Simulation simulation = Make(Options("box+bottle+can+doughnut", 300));
  for (int index = 0; index < 300; index += 3) {
    for (std::size_t b = 1; b < 4; ++b) {
      const Vec3d between = simulation.TruthAt(index, b).object.pose.translation() -
                            simulation.TruthAt(index, b - 1).object.pose.translation();
      EXPECT_GT(between.norm(),
                BoundingRadius(simulation.mesh(b)) + BoundingRadius(simulation.mesh(b - 1)));
    }
  }
}

TEST(SeveralObjects, HiddenOne_IsGoneForASecond) {
  SimulationOptions options = Options("box+bottle", 90);
  options.hide = 2;
  Simulation simulation = Make(options);
  for (const auto& [index, seen] : {std::pair{29, true}, {30, false}, {59, false}, {60, true}}) {
    DepthFrame frame;
    simulation.Render(index, frame);
    EXPECT_EQ(CountValues(frame.mask)[2] > 0, seen) << index;
    EXPECT_GT(CountValues(frame.mask)[1], 0) << index;
  }
}

TEST(SeveralObjects, SloppyMask_ShowsAllLabels) {
  SimulationOptions options = Options("box+bottle", 4);
  options.mask = MaskKind::kSloppy;
  Simulation simulation = Make(options);
  DepthFrame frame;
  simulation.Render(0, frame);
  for (const std::size_t label : {1U, 2U})
    EXPECT_GT(CountValues(frame.mask)[label], CountValues(simulation.gt_mask())[label]);
}

}  // namespace
}  // namespace disflow::host
