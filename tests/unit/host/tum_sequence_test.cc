// SPDX-License-Identifier: BSD-3-Clause
#include "foreign_sequence.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

/// Four images of a camera that skipped one; it flies along x at 1 m/s and turns about z.
class TumSequence : public ForeignSequence {
 protected:
  static constexpr double kTurn_rps = 0.5;

  void SetUp() override {
    dir_.Write("depth.txt",
               "# depth maps\n# timestamp filename\n"
               "1305031102.160407 depth/1305031102.160407.png\n"
               "1305031102.226738 depth/1305031102.226738.png\n"
               "1305031102.360000 depth/1305031102.360000.png\n"
               "1305031102.426000 depth/1305031102.426000.png\n");
    for (const char* stamp : {"160407", "226738", "360000", "426000"}) {
      WriteDepth(std::string("depth/1305031102.") + stamp + ".png", 5000);
    }
    std::string poses = "# timestamp tx ty tz qx qy qz qw\n";
    for (int i = 0; i < 40; ++i) {
      const double t_s = 0.1 + 0.01 * i;
      const double half_rad = 0.5 * kTurn_rps * t_s;
      poses += "1305031102." + std::to_string(100 + 10 * i) + " " + std::to_string(t_s) +
               " 2 3 0 0 " + std::to_string(std::sin(half_rad)) + " " +
               std::to_string(std::cos(half_rad)) + "\n";
    }
    dir_.Write("groundtruth.txt", poses);
  }
  [[nodiscard]] ReplayOptions Replay() const {
    ReplayOptions options;
    options.dir = dir_.path();
    options.camera = PinholeCamera{525.0F, 525.0F, 19.5F, 14.5F};
    return options;
  }
};

TEST_F(TumSequence, IsPlayedWithItsOwnStampsAndUnit) {
  const std::vector<CopiedFrame> frames = Play(Replay());
  ASSERT_EQ(frames.size(), 4U);
  const StampNs kSecond_ns = 1'305'031'102'000'000'000;
  const StampNs stamps_ns[] = {160'407'000, 226'738'000, 360'000'000, 426'000'000};
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(frames[i].fault.ok()) << frames[i].fault.message;
    EXPECT_EQ(frames[i].frame.stamp_ns, kSecond_ns + stamps_ns[i]);
    EXPECT_EQ(frames[i].frame.depth.unit_m, 0.0002F) << "a value of 5000 is one metre";
    EXPECT_FALSE(frames[i].frame.has_T_wc) << "poses are used only when asked for";
    EXPECT_EQ(frames[i].frame.camera.cx_px, 19.5F);
  }
}

TEST_F(TumSequence, Scale_ReplacesTheUnitAndCameraFileIsUsed) {
  dir_.Write("camera-intrinsics.txt", "500 0 20\n0 501 15\n0 0 1\n");
  ReplayOptions options = Replay();
  options.camera.reset();
  options.unit_m = 0.001;
  const std::vector<CopiedFrame> frames = Play(options);
  ASSERT_EQ(frames.size(), 4U);
  EXPECT_EQ(frames[0].frame.depth.unit_m, 0.001F);
  EXPECT_EQ(frames[0].frame.camera.fy_px, 501.0F);
}

TEST_F(TumSequence, CameraPoses_AreThoseOfTheStamps) {
  ReplayOptions options = Replay();
  options.world_poses = WorldPoses::kGiven;
  for (const CopiedFrame& copy : Play(options)) {
    const DepthFrame& frame = copy.frame;
    ASSERT_TRUE(frame.has_T_wc);
    const double t_s = static_cast<double>(frame.stamp_ns - 1'305'031'102'000'000'000) * 1e-9;
    // Between two poses the motion is a screw, which leaves the line by less than this.
    EXPECT_LT((frame.T_wc.translation() - Vec3(static_cast<float>(t_s), 2.0F, 3.0F)).norm(), 1e-5F);
    const auto turn = static_cast<float>(kTurn_rps * t_s);
    EXPECT_LT((frame.T_wc.rotation() - ExpSo3(Vec3(0.0F, 0.0F, turn))).norm(), 1e-5F);
  }
}

TEST_F(TumSequence, StampsWithoutPosesAround_HaveNone) {
  dir_.Write("groundtruth.txt",
             "1305031102.20 0 0 0 0 0 0 1\n1305031102.23 0 0 0 0 0 0 1\n"
             "1305031102.40 0 0 0 0 0 0 1\n");
  ReplayOptions options = Replay();
  options.world_poses = WorldPoses::kGiven;
  const std::vector<CopiedFrame> frames = Play(options);
  ASSERT_EQ(frames.size(), 4U);
  EXPECT_FALSE(frames[0].frame.has_T_wc) << "before the first";
  EXPECT_TRUE(frames[1].frame.has_T_wc);
  EXPECT_FALSE(frames[2].frame.has_T_wc) << "in a gap";
  EXPECT_FALSE(frames[3].frame.has_T_wc) << "behind the last";
}

TEST_F(TumSequence, BadPoses_AreNamedWithTheirLine) {
  ReplayOptions options = Replay();
  options.world_poses = WorldPoses::kGiven;
  for (const char* second : {"2 0 0 0 0 0 0 2", "2 0 0 0 0 0 0", "1 0 0 0 0 0 0 1",
                             "x 0 0 0 0 0 0 1", "-2 0 0 0 0 0 0 1", "2 nan 0 0 0 0 0 1"}) {
    dir_.Write("groundtruth.txt", std::string("1 0 0 0 0 0 0 1\n") + second + "\n");
    ExpectRefused(options, Status::kCorrupt, "groundtruth.txt:2");
  }
  fs::remove(dir_.path() / "groundtruth.txt");
  ExpectRefused(options, Status::kNotFound, "groundtruth.txt");
}

TEST_F(TumSequence, BadList_IsNamedWithItsLine) {
  for (const char* line : {"1305031102.5", "soon depth/1.png", "-1 depth/1.png"}) {
    dir_.Write("depth.txt", std::string(line) + "\n");
    ExpectRefused(Replay(), Status::kCorrupt, "depth.txt:1");
  }
  dir_.Write("depth.txt", "# nothing\n");
  ExpectRefused(Replay(), Status::kNotFound, "depth.txt");
}

TEST_F(TumSequence, ImageOutsideTheFolder_IsRefused) {
  for (const char* name : {"/etc/passwd", "../1.png", "depth/../../1.png"}) {
    dir_.Write("depth.txt", std::string("1 ") + name + "\n");
    ExpectRefused(Replay(), Status::kCorrupt, "not in this folder");
  }
}

TEST_F(TumSequence, MissingImage_IsALostFrameAndNamedInFull) {
  fs::remove(dir_.path() / "depth" / "1305031102.360000.png");
  const std::vector<CopiedFrame> frames = Play(Replay());
  ASSERT_EQ(frames.size(), 4U);
  EXPECT_FALSE(frames[2].fault.ok());
  EXPECT_NE(std::string(frames[2].fault.message).find("depth/1305031102.360000.png"),
            std::string::npos);
  EXPECT_TRUE(frames[3].fault.ok());
}

TEST_F(TumSequence, Rate_IsRefusedSinceStampsAreThere) {
  ReplayOptions options = Replay();
  options.rate_hz = 30.0;
  ExpectRefused(options, Status::kInvalidUri, "depth.txt");
}

TEST_F(TumSequence, WithoutIntrinsics_AsksForThem) {
  ReplayOptions options = Replay();
  options.camera.reset();
  ExpectRefused(options, Status::kNotFound, "K=fx,fy,cx,cy");
}

}  // namespace
}  // namespace disflow::host
