// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <limits>

#include "disflow/depth/depth_reader.h"
#include "disflow/field/distance_query.h"
#include "disflow/host/png_image.h"
#include "disflow/tracker.h"
#include "surface_mesh.h"
#include "test_data.h"

namespace disflow::test {
namespace {

namespace fs = std::filesystem;
using Limits = profiles::Dense;

constexpr float kUnit_m = 1e-4F;

/// Cameras 1 to 4 of the recording.
constexpr std::array<PinholeCamera, 4> kCameras = {{{570.9361F, 570.9376F, 306.8789F, 238.8476F},
                                                    {572.3318F, 572.3316F, 309.9968F, 230.6296F},
                                                    {568.9403F, 568.9419F, 308.4583F, 225.8232F},
                                                    {567.9881F, 567.9995F, 310.5243F, 223.9443F}}};

/// One image of the turntable with its known pose.
struct View {
  host::GrayImage image;
  std::vector<std::uint8_t>
      mask;  ///< The images are masked already: all that is there is the bottle.
  PinholeCamera camera;
  PoseObjectFromCamera T_oc;
};

/// The k-th image's number and camera, in the order of the poses: 93, 102, ..., 354, 6, 15,
/// ..., 87.
fs::path ImageName(int k) {
  constexpr std::array<int, 6> kCameraCycle = {1, 2, 3, 4, 3, 2};
  const int number = k < 30 ? 93 + 9 * k : 6 + 9 * (k - 30);
  return "frame" + std::to_string(number) + "_cam" +
         std::to_string(kCameraCycle[static_cast<std::size_t>(k % 6)]) + ".png";
}

std::vector<View> LoadViews(const fs::path& folder) {
  std::vector<View> views;
  std::ifstream poses(folder / "pose" / "poses.txt");
  std::array<float, 16> p{};
  const auto read_pose = [&] {
    for (float& value : p) poses >> value;
    return poses.good();
  };
  for (int k = 0; read_pose(); ++k) {
    Mat3 rotation;
    rotation << p[0], p[4], p[8], p[1], p[5], p[9], p[2], p[6], p[10];
    const fs::path name = ImageName(k);
    const char camera = name.string()[name.string().find("cam") + 3];
    host::GrayImage image;
    const hal::Fault fault = host::ReadGrayPng(folder / "masked_depth" / name, image);
    EXPECT_TRUE(fault.ok()) << fault.message;
    std::vector<std::uint8_t> mask(image.pixels.size());
    std::transform(image.pixels.begin(), image.pixels.end(), mask.begin(), [](std::uint16_t depth) {
      return static_cast<std::uint8_t>(depth > 0 ? 255 : 0);
    });
    views.push_back({std::move(image), std::move(mask),
                     kCameras[static_cast<std::size_t>(camera - '1')],
                     PoseObjectFromCamera(rotation, Vec3(p[3], p[7], p[11])).Normalized()});
  }
  return views;
}

DepthFrame FrameOf(const View& view, int k) {
  DepthFrame frame;
  frame.depth = {view.image.pixels.data(), view.image.width_px,
                 view.image.height_px,     view.image.width_px * std::ptrdiff_t{2},
                 DepthFormat::kUint16,     kUnit_m};
  frame.mask = {view.mask.data(), view.image.width_px, view.image.height_px, view.image.width_px};
  frame.camera = view.camera;
  frame.stamp_ns = std::int64_t{1'000'000'000} * (k + 1);
  return frame;
}

Config FusionConfig() {
  Config config;
  // Depth comes in steps of 1/8 px of disparity, so that small windows look free of noise.
  config.sampler.inverse_depth_std_per_m = 1.2e-3F;
  config.sampler.target_blocks = 800;
  config.field.retrain_budget = 1000;
  config.field.fuse_budget = 5000;
  return config;
}

/// Distances of a view's points to the fused surface, every fourth pixel, in ascending order. A
/// point that no surface answers for counts as infinitely far, lest gaps flatter the rest.
std::vector<float> Distances(const View& view, const Tracker<Limits>& tracker) {
  static GpWorkspace<Limits::kMaxTrainingSamples> scratch;
  DistanceQuerier<Limits> querier(tracker.field(), scratch, 0.01F);
  std::vector<float> distances_m;
  const DepthFrame frame = FrameOf(view, 0);
  const DepthReader depth(frame.depth, 0.1F, 4.0F);
  for (int v = 0; v < view.image.height_px; v += 4) {
    for (int u = 0; u < view.image.width_px; u += 4) {
      const float depth_m = depth.At(u, v);
      if (depth_m <= 0.0F) continue;
      const Vec3 x_o = view.T_oc * view.camera.BackProject(static_cast<float>(u),
                                                           static_cast<float>(v), depth_m);
      const auto query = querier.Query(x_o);
      distances_m.push_back(query.ok() ? std::abs(query.value.distance_m)
                                       : std::numeric_limits<float>::infinity());
    }
  }
  std::sort(distances_m.begin(), distances_m.end());
  return distances_m;
}

/// Fuses all views but one into an empty model.
void FuseAllBut(std::size_t left_out, const std::vector<View>& views, Tracker<Limits>& tracker) {
  tracker.Reset();
  Estimate estimate;
  // Stamps go on over the resets: time never runs backwards.
  static int frame = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (k == left_out) continue;
    ASSERT_EQ(tracker.Fuse(FrameOf(views[k], frame++), views[k].T_oc, estimate), Status::kOk) << k;
  }
}

constexpr std::size_t kNone = 1000;

/// One tracker for all tests: it is large.
Tracker<Limits>& SharedTracker() {
  static Tracker<Limits> tracker(FusionConfig());
  return tracker;
}

TEST(BottleFusion, FortyViewsWithKnownPoses_BecomeOneBottle) {
  const fs::path folder = TestData("bigbird_detergent");
  DISFLOW_SKIP_WITHOUT(folder);
  const std::vector<View> views = LoadViews(folder);
  ASSERT_EQ(views.size(), 40U);
  Tracker<Limits>& tracker = SharedTracker();
  FuseAllBut(kNone, views, tracker);
  for (const View& view : views) {
    const std::vector<float> distances_m = Distances(view, tracker);
    ASSERT_FALSE(distances_m.empty());
    EXPECT_LT(distances_m[distances_m.size() / 2], 0.0015F);
    EXPECT_LT(distances_m[distances_m.size() * 9 / 10], 0.004F);
  }

  static SurfaceWorkspace<Limits> workspace;
  apps::SurfaceMesh mesh;
  SurfaceOptions options;
  options.min_observations = 2;
  ASSERT_TRUE(ExtractSurface(tracker.field(), options, workspace, mesh).ok());
  Vec3 low = mesh.vertices().front().position_m;
  Vec3 high = low;
  for (const SurfaceVertex& vertex : mesh.vertices()) {
    low = low.cwiseMin(vertex.position_m);
    high = high.cwiseMax(vertex.position_m);
  }
  EXPECT_NEAR((high - low).maxCoeff(), 0.27F, 0.03F) << "the bottle's height";
  const std::string ply = mesh.FormatPly();
  std::ofstream(DISFLOW_OUTPUT "/bottle.ply", std::ios::binary)
      .write(ply.data(), static_cast<std::streamsize>(ply.size()));
}

/// Every view is judged against a surface into which it never went: forty fusions of 39 views.
TEST(BottleFusion, EveryView_LiesOnTheSurfaceFusedFromTheOthers) {
  const fs::path folder = TestData("bigbird_detergent");
  DISFLOW_SKIP_WITHOUT(folder);
  const std::vector<View> views = LoadViews(folder);
  ASSERT_EQ(views.size(), 40U);
  std::vector<float> medians_m;
  for (std::size_t k = 0; k < views.size(); ++k) {
    FuseAllBut(k, views, SharedTracker());
    const std::vector<float> distances_m = Distances(views[k], SharedTracker());
    ASSERT_FALSE(distances_m.empty());
    medians_m.push_back(distances_m[distances_m.size() / 2]);
    EXPECT_LE(medians_m.back(), 0.0015F) << "view " << k;
  }
  std::sort(medians_m.begin(), medians_m.end());
  std::printf("median distance of a left-out view: %.2f mm in the middle, %.2f mm at worst\n",
              1e3 * static_cast<double>(medians_m[medians_m.size() / 2]),
              1e3 * static_cast<double>(medians_m.back()));
}

}  // namespace
}  // namespace disflow::test
