// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "disflow/host/png_image.h"
#include "recorded_sequence.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

/// A folder of 16-bit PNG, as depth cameras are often recorded; pixel values tell the frame.
class PngSequence : public testing::Test {
 protected:
  static constexpr int kWidth_px = 40;
  static constexpr int kHeight_px = 30;
  static constexpr int kFrames = 12;

  void Write(const std::string& folder) const {
    dir_.Write("camera-intrinsics.txt", "585.5 0 20\n0 586 15\n0 0 1\n");
    fs::create_directories(dir_.path() / folder);
    for (int i = 0; i < kFrames; ++i) {
      const std::vector<std::uint16_t> pixels(kWidth_px * kHeight_px,
                                              static_cast<std::uint16_t>(1000 + i));
      // Without leading zeros: "frame10" sorts before "frame9" as text.
      const std::string name = "frame" + std::to_string(i) + "_cam" + std::to_string(9 - i % 4);
      ASSERT_TRUE(
          WriteGray16Png(dir_.path() / folder / (name + ".png"), pixels, kWidth_px, kHeight_px)
              .ok());
      dir_.Write("pose/frame" + std::to_string(i) + ".pose.txt",
                 "0 -1 0 " + std::to_string(i) + "\n1 0 0 2\n0 0 1 3\n0 0 0 1\n");
    }
  }
  [[nodiscard]] ReplayOptions Replay() const {
    ReplayOptions options;
    options.dir = dir_.path();
    options.rate_hz = 30.0;
    return options;
  }
  static int Value(const CopiedFrame& frame) {
    std::uint16_t value = 0;
    std::memcpy(&value, frame.depth.data(), sizeof(value));
    return value;
  }

  apps::ScratchDir dir_;
};

TEST_F(PngSequence, IsPlayedInNaturalOrderInMillimetres) {
  Write("depth");
  ReplaySensor sensor(Replay());
  const hal::Fault opened = sensor.Open();
  ASSERT_TRUE(opened.ok()) << opened.message;
  const std::vector<CopiedFrame> frames = PlayAll(sensor);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(kFrames));
  for (int i = 0; i < kFrames; ++i) {
    const CopiedFrame& frame = frames[static_cast<std::size_t>(i)];
    ASSERT_TRUE(frame.fault.ok()) << frame.fault.message;
    EXPECT_EQ(Value(frame), 1000 + i);
    EXPECT_EQ(CheckFrame(frame.frame, 640, 480), Status::kOk);
    EXPECT_EQ(frame.frame.depth.unit_m, 0.001F);
    EXPECT_EQ(frame.frame.camera.fx_px, 585.5F);
    EXPECT_EQ(frame.frame.camera.cy_px, 15.0F);
    EXPECT_FALSE(frame.frame.mask.given());
    EXPECT_FALSE(frame.frame.has_T_wc) << "poses are used only when asked for";
  }
}

TEST_F(PngSequence, WithoutRate_IsRefusedSinceNobodyKnowsItsStamps) {
  Write("depth");
  ReplayOptions options = Replay();
  options.rate_hz.reset();
  const hal::Fault fault = ReplaySensor(options).Open();
  EXPECT_EQ(fault.status, Status::kInvalidUri);
  EXPECT_NE(std::string(fault.message).find("?fps=30"), std::string::npos) << fault.message;
}

TEST_F(PngSequence, Rate_IsThatOfTheStamps) {
  Write("depth");
  ReplayOptions options = Replay();
  options.rate_hz = 12.5;
  ReplaySensor sensor(options);
  ASSERT_TRUE(sensor.Open().ok());
  const std::vector<CopiedFrame> frames = PlayAll(sensor);
  for (int i = 1; i < kFrames; ++i) {
    EXPECT_EQ(frames[static_cast<std::size_t>(i)].frame.stamp_ns - frames[0].frame.stamp_ns,
              StampNs{80'000'000} * i);
  }
}

TEST_F(PngSequence, RateBesideStamps_IsRefused) {
  Write("depth");
  dir_.Write("data.txt", "0 1\n");
  const hal::Fault fault = ReplaySensor(Replay()).Open();
  EXPECT_EQ(fault.status, Status::kInvalidUri);
  EXPECT_NE(std::string(fault.message).find("data.txt"), std::string::npos) << fault.message;
}

TEST_F(PngSequence, MaskedDepthFolderAndScale_AreUnderstood) {
  Write("masked_depth");
  ReplayOptions options = Replay();
  options.unit_m = 0.0001;
  ReplaySensor sensor(options);
  ASSERT_TRUE(sensor.Open().ok());
  EXPECT_EQ(sensor.info().width_px, kWidth_px);
  EXPECT_EQ(PlayAll(sensor)[0].frame.depth.unit_m, 0.0001F);
}

/// A folder of nothing but depth images and their camera.
class LooseImages : public PngSequence {
 protected:
  void WriteImage(const std::string& name, std::uint16_t value) const {
    const std::vector<std::uint16_t> pixels(kWidth_px * kHeight_px, value);
    ASSERT_TRUE(WriteGray16Png(dir_.path() / name, pixels, kWidth_px, kHeight_px).ok());
  }
  void SetUp() override { dir_.Write("camera-intrinsics.txt", "585.5 0 20\n0 586 15\n0 0 1\n"); }
};

TEST_F(LooseImages, ArePlayedInNaturalOrder) {
  for (std::uint16_t i = 8; i < 12; ++i) WriteImage("depth_" + std::to_string(i) + ".png", i);
  ReplaySensor sensor(Replay());
  const hal::Fault opened = sensor.Open();
  ASSERT_TRUE(opened.ok()) << opened.message;
  const std::vector<CopiedFrame> frames = PlayAll(sensor);
  ASSERT_EQ(frames.size(), 4U);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(Value(frames[static_cast<std::size_t>(i)]), 8 + i);
}

/// Plays a folder whose data.txt lists an image that is not there.
std::string MessageOfMissing(const ReplayOptions& replay) {
  ReplayOptions options = replay;
  options.rate_hz.reset();
  ReplaySensor sensor(options);
  EXPECT_TRUE(sensor.Open().ok());
  const std::vector<CopiedFrame> frames = PlayAll(sensor);
  return frames.size() == 2 ? frames[1].fault.message : "other frames than two";
}

TEST_F(LooseImages, MissingOne_IsNamedInFull) {
  WriteImage("000000.png", 1);
  dir_.Write("data.txt", "0 1\n3 2\n");
  EXPECT_NE(MessageOfMissing(Replay()).find("/000003.png"), std::string::npos)
      << MessageOfMissing(Replay());
}

TEST_F(LooseImages, MissingOneAmongNamesWithoutZerosAndWithAnEnding_IsNamedInFull) {
  WriteImage("frame-7.depth.png", 1);
  dir_.Write("data.txt", "7 1\n12 2\n");
  EXPECT_NE(MessageOfMissing(Replay()).find("/frame-12.depth.png"), std::string::npos)
      << MessageOfMissing(Replay());
}

TEST_F(LooseImages, OfSeveralKinds_AreRefusedWithAWayOut) {
  WriteImage("colour_1.png", 1);
  WriteImage("depth_1.png", 1);
  ReplaySensor sensor(Replay());
  const hal::Fault opened = sensor.Open();
  EXPECT_EQ(opened.status, Status::kUnsupported);
  EXPECT_NE(std::string(opened.message).find("'colour_*' and 'depth_*'"), std::string::npos)
      << opened.message;
}

TEST_F(PngSequence, Poses_AreUsedWhenAskedFor) {
  Write("depth");
  ReplayOptions options = Replay();
  options.world_poses = WorldPoses::kGiven;
  ReplaySensor sensor(options);
  const hal::Fault opened = sensor.Open();
  ASSERT_TRUE(opened.ok()) << opened.message;
  const std::vector<CopiedFrame> frames = PlayAll(sensor);
  for (int i = 0; i < kFrames; ++i) {
    const DepthFrame& frame = frames[static_cast<std::size_t>(i)].frame;
    ASSERT_TRUE(frame.has_T_wc);
    EXPECT_LT(
        (frame.T_wc * Vec3(1.0F, 0.0F, 0.0F) - Vec3(static_cast<float>(i), 3.0F, 3.0F)).norm(),
        1e-5F);
  }
}

TEST_F(PngSequence, MissingOrBadPoses_AreNamed) {
  Write("depth");
  ReplayOptions options = Replay();
  options.world_poses = WorldPoses::kGiven;
  dir_.Write("pose/frame3.pose.txt", "2 0 0 0\n0 2 0 0\n0 0 2 0\n0 0 0 1\n");
  const hal::Fault not_rigid = ReplaySensor(options).Open();
  EXPECT_EQ(not_rigid.status, Status::kInvalidTransform);
  EXPECT_NE(std::string(not_rigid.message).find("frame3.pose.txt"), std::string::npos);
  fs::remove(dir_.path() / "pose" / "frame3.pose.txt");
  const hal::Fault too_few = ReplaySensor(options).Open();
  EXPECT_EQ(too_few.status, Status::kCorrupt);
  EXPECT_NE(std::string(too_few.message).find("11"), std::string::npos) << too_few.message;
}

TEST_F(PngSequence, DamagedImage_LosesThatFrameOnly) {
  Write("depth");
  dir_.Write("depth/frame0_cam9.png", "damaged");
  dir_.Write("depth/frame5_cam8.png", "damaged");
  ReplaySensor sensor(Replay());
  ASSERT_TRUE(sensor.Open().ok()) << "another image tells the size";
  const std::vector<CopiedFrame> frames = PlayAll(sensor);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(kFrames));
  for (int i = 0; i < kFrames; ++i) {
    const bool damaged = i == 0 || i == 5;
    EXPECT_EQ(frames[static_cast<std::size_t>(i)].fault.status,
              damaged ? Status::kCorrupt : Status::kOk);
  }
}

TEST_F(PngSequence, NoReadableImage_IsAnError) {
  Write("depth");
  for (const auto& entry : fs::directory_iterator(dir_.path() / "depth")) {
    fs::resize_file(entry.path(), 10);
  }
  EXPECT_FALSE(ReplaySensor(Replay()).Open().ok());
}

TEST_F(PngSequence, BadIntrinsics_AreNamed) {
  Write("depth");
  for (const char* text : {"", "1 2 3\n4 5 6\n", "a b c\nd e f\ng h i\n", "nan 0 1\n0 5 1\n0 0 1\n",
                           "0 0 1\n0 5 1\n0 0 1\n"}) {
    dir_.Write("camera-intrinsics.txt", text);
    const hal::Fault fault = ReplaySensor(Replay()).Open();
    EXPECT_FALSE(fault.ok()) << text;
    EXPECT_NE(std::string(fault.message).find("camera-intrinsics.txt"), std::string::npos)
        << fault.message;
  }
}

TEST_F(PngSequence, GivenCamera_ReplacesTheFile) {
  Write("depth");
  fs::remove(dir_.path() / "camera-intrinsics.txt");
  ReplayOptions options = Replay();
  options.camera = PinholeCamera{500.0F, 501.0F, 20.0F, 15.0F};
  ReplaySensor sensor(options);
  ASSERT_TRUE(sensor.Open().ok());
  EXPECT_EQ(PlayAll(sensor)[0].frame.camera.fy_px, 501.0F);
}

}  // namespace
}  // namespace disflow::host
