// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "child_process.h"
#include "disflow/host/object_meshes.h"
#include "disflow/host/png_image.h"
#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"
#include "evaluation.h"
#include "scratch_folder.h"

/// @file
/// The same images in the layouts of others: each must be tracked as the others are.

namespace disflow::test {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 20;
constexpr double kRate_hz = 15.0;
constexpr StampNs kSecond_ns = 1'000'000'000;

StampNs StampOf(int k) {
  return kSecond_ns + std::llround(k * (static_cast<double>(kSecond_ns) / kRate_hz));
}

std::string Seconds(StampNs stamp_ns) {
  const std::string ns = std::to_string(stamp_ns % kSecond_ns);
  return std::to_string(stamp_ns / kSecond_ns) + "." + std::string(9 - ns.size(), '0') + ns;
}

std::string SixDigits(int number) {
  const std::string text = std::to_string(number);
  return std::string(6 - text.size(), '0') + text;
}

/// @param factor Of the translation.
std::string Join(const Mat<double, 3, 3>& R, const Mat<double, 3>& t, double factor) {
  std::ostringstream text;
  text.precision(17);
  text << R"("cam_R_m2c":[)";
  for (int i = 0; i < 9; ++i) text << (i > 0 ? "," : "") << R(i / 3, i % 3);
  text << R"(],"cam_t_m2c":[)" << factor * t.x() << "," << factor * t.y() << "," << factor * t.z();
  return text.str() + "]";
}

/// A bottle that moves fast, in steps of 0.2 mm, seen 15 times per second.
class ForeignSequences : public ScratchFolderTest {
 protected:
  void SetUp() override {
    host::SimulationOptions options;
    options.motion = host::MotionKind::kFast;
    options.noise = host::NoiseKind::kWhite;
    options.frames = kFrames;
    options.fps = kRate_hz;
    options.width_px = 320;
    options.height_px = 180;
    const host::TriangleMesh mesh = host::MakeObjectMesh(host::ObjectKind::kBottle);
    host::Simulation simulation(options, mesh);
    for (int k = 0; k < kFrames; ++k) {
      DepthFrame frame;
      simulation.Render(k, frame);
      ASSERT_NO_FATAL_FAILURE(AddImages(k, frame, simulation.gt_mask()));
      const auto& T_co = simulation.TruthAt(k).object.pose;
      const std::string key = (k > 0 ? ",\"" : "\"") + std::to_string(k) + "\":";
      cameras_ += key + R"({"cam_K":[)" + std::to_string(frame.camera.fx_px) + ",0," +
                  std::to_string(frame.camera.cx_px) + ",0," + std::to_string(frame.camera.fy_px) +
                  "," + std::to_string(frame.camera.cy_px) + R"(,0,0,1],"depth_scale":0.2})";
      truth_ += key + "[{" + Join(T_co.rotation(), T_co.translation(), 1e3) + R"(,"obj_id":1}])";
      camera_ = frame.camera;
    }
    WriteLists(mesh);
  }

  void AddImages(int k, const DepthFrame& frame, const MaskView& mask) {
    const int width_px = frame.depth.width_px;
    const int height_px = frame.depth.height_px;
    std::vector<std::uint16_t> pixels;
    for (int v = 0; v < height_px; ++v) {
      for (int u = 0; u < width_px; ++u) {
        float depth_m = 0.0F;
        std::memcpy(&depth_m, frame.depth.row(v) + u * 4, sizeof(depth_m));
        pixels.push_back(static_cast<std::uint16_t>(std::lround(5000.0F * depth_m)));
      }
    }
    const std::string name = SixDigits(k);
    const auto write = [&](const std::string& depth_file, const std::string& mask_file) {
      fs::create_directories(fs::path(Path(depth_file)).parent_path());
      fs::create_directories(fs::path(Path(mask_file)).parent_path());
      ASSERT_TRUE(host::WriteGray16Png(Path(depth_file), pixels, width_px, height_px).ok());
      ASSERT_TRUE(
          host::WriteGray8Png(Path(mask_file), mask.data, width_px, height_px, mask.stride_bytes)
              .ok());
    };
    write("own/depth/" + name + ".png", "own/masks/gt/object_" + name + ".png");
    write("tum/depth/" + Seconds(StampOf(k)) + ".png", "tum/masks/gt/object_" + name + ".png");
    write("set/test/1/depth/" + name + ".png", "set/test/1/mask_visib/" + name + "_000000.png");
    stamps_ += std::to_string(k) + " " + Seconds(StampOf(k)) + "\n";
    list_ += Seconds(StampOf(k)) + " depth/" + Seconds(StampOf(k)) + ".png\n";
  }

  void WriteLists(const host::TriangleMesh& mesh) const {
    WriteFile(Path("own/data.txt"), stamps_);
    WriteFile(Path("tum/depth.txt"), list_);
    WriteFile(Path("set/test/1/scene_camera.json"), "{" + cameras_ + "}");
    WriteFile(Path("set/test/1/scene_gt.json"), "{" + truth_ + "}");
    std::ostringstream model;
    model << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
          << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
          << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& vertex : mesh.vertices) model << 1e3 * vertex.transpose() << "\n";
    for (const auto& [a, b, c] : mesh.triangles) model << "3 " << a << " " << b << " " << c << "\n";
    fs::create_directories(Path("set/models"));
    WriteFile(Path("set/models/obj_000001.ply"), model.str());
  }

  /// @return The trajectory.
  [[nodiscard]] std::string Track(const std::string& address) const {
    std::ostringstream k;
    k << "&K=" << camera_.fx_px << "," << camera_.fy_px << "," << camera_.cx_px << ","
      << camera_.cy_px;
    const Outcome outcome = RunTrack({"--sensor", "replay:" + address + k.str(), "--csv",
                                      Path("run.csv"), "--no-timing", "--headless"},
                                     scratch());
    EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
    return ReadFile(Path("run.csv"));
  }

  PinholeCamera camera_;
  std::string stamps_;
  std::string list_;
  std::string cameras_;
  std::string truth_;
};

TEST_F(ForeignSequences, SameImages_AreTheSameTrajectoryInEveryLayout) {
  const std::string own = Track(Path("own") + "?scale=0.0002");
  EXPECT_GT(own.size(), 1000U);
  EXPECT_EQ(Track(Path("tum") + "?mask=gt"), own);
  EXPECT_EQ(Track(Path("set/test/1") + "?fps=15"), own);
}

TEST_F(ForeignSequences, BopScene_IsJudgedByItsOwnTruthAndModel) {
  (void)Track(Path("set/test/1") + "?fps=15");
  const apps::Report report = apps::Evaluate(
      {.sequence = Path("set/test/1"), .csv = Path("run.csv"), .model = {}, .mesh = {}});
  EXPECT_EQ(report.run.frames.size(), std::size_t{kFrames});
  EXPECT_LT(report.poses.translation_m.rms, 0.005);
  EXPECT_GT(report.poses.add_auc, 0.9);
}

TEST_F(ForeignSequences, WithoutRate_IsWrongUsageThatSaysWhatToAdd) {
  const Outcome outcome = RunTrack({"--sensor", "replay:" + Path("set/test/1")}, scratch());
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_NE(outcome.err.find("fps="), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace disflow::test
