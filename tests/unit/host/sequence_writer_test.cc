// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/sequence_writer.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <vector>

#include "disflow/host/png_image.h"
#include "disflow/host/simulated_shapes.h"
#include "recorded_sequence.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

TEST_F(RecordedSequence, Replayed_GivesTheSameBits) {
  ReplaySensor sensor(Replay());
  const hal::Fault opened = sensor.Open();
  ASSERT_TRUE(opened.ok()) << opened.message;
  const std::vector<CopiedFrame> replayed = PlayAll(sensor);
  ASSERT_EQ(replayed.size(), frames_.size());
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    ASSERT_TRUE(replayed[i].fault.ok()) << replayed[i].fault.message;
    EXPECT_EQ(replayed[i].depth, frames_[i].depth);
    EXPECT_EQ(replayed[i].mask, frames_[i].mask);
    EXPECT_EQ(replayed[i].frame.stamp_ns, frames_[i].frame.stamp_ns);
    EXPECT_EQ(replayed[i].frame.camera.fx_px, frames_[i].frame.camera.fx_px);
    EXPECT_EQ(replayed[i].frame.camera.cy_px, frames_[i].frame.camera.cy_px);
    ASSERT_TRUE(replayed[i].frame.has_T_wc);
    EXPECT_LT((replayed[i].frame.T_wc.rotation() - frames_[i].frame.T_wc.rotation()).norm(), 1e-6F);
    EXPECT_LT((replayed[i].frame.T_wc.translation() - frames_[i].frame.T_wc.translation()).norm(),
              1e-7F);
  }
}

TEST_F(RecordedSequence, Truth_IsWrittenAsAxisAngleAndTwist) {
  std::istringstream poses(TextOf(path() / "gt" / "poses.txt"));
  std::istringstream velocities(TextOf(path() / "gt" / "velocities.txt"));
  for (const FrameTruth& truth : truths_) {
    Vec3d t;
    Vec3d axis;
    double angle_rad = 0.0;
    poses >> t.x() >> t.y() >> t.z() >> axis.x() >> axis.y() >> axis.z() >> angle_rad;
    ASSERT_TRUE(poses);
    EXPECT_LT((t - truth.object.pose.translation()).norm(), 1e-10);
    EXPECT_NEAR(axis.norm(), 1.0, 1e-12);
    EXPECT_LT((ExpSo3(Vec3d(axis * angle_rad)) - truth.object.pose.rotation()).norm(), 1e-10);
    Vec3d v;
    Vec3d w;
    velocities >> v.x() >> v.y() >> v.z() >> w.x() >> w.y() >> w.z();
    ASSERT_TRUE(velocities);
    EXPECT_LT((v - truth.object.linear_mps).norm(), 1e-10);
    EXPECT_LT((w - truth.object.angular_rps).norm(), 1e-10);
  }
}

TEST_F(RecordedSequence, SeveralObjects_HaveMasksAndTruthOfTheirOwn) {
  const fs::path folder = path().parent_path() / "several";
  SequenceWriter writer;
  ASSERT_TRUE(writer.Open(folder, "", false).ok());
  DepthFrame frame = frames_[0].frame;
  frame.depth.data = frames_[0].depth.data();
  ASSERT_TRUE(writer.AddFrame(frame).ok());
  std::vector<std::uint8_t> labels(64 * 48, 0);
  labels[5] = 1;
  labels[6] = 2;
  for (const auto& [name, label] : {std::pair{"cup", std::uint8_t{1}}, {"pen", std::uint8_t{2}}}) {
    const MaskView mask{labels.data(), 64, 48, 64, label};
    ASSERT_TRUE(writer.AddMaskOf(name, "gt", mask).ok());
    ASSERT_TRUE(writer.AddTruthOf(name, truths_[label].object).ok());
  }
  ASSERT_TRUE(writer.Finish().ok());
  GrayImage pen;
  ASSERT_TRUE(ReadGrayPng(folder / "masks" / "gt" / "pen_0.png", pen).ok());
  EXPECT_EQ(pen.pixels[5], 0);
  EXPECT_EQ(pen.pixels[6], 255);
  for (const char* name : {"cup", "pen"}) {
    EXPECT_TRUE(fs::exists(folder / "gt" / name / "poses.txt"));
    EXPECT_TRUE(fs::exists(folder / "gt" / name / "velocities.txt"));
  }
  EXPECT_NE(TextOf(folder / "gt" / "cup" / "poses.txt"),
            TextOf(folder / "gt" / "pen" / "poses.txt"));
}

TEST_F(RecordedSequence, NotEmptyFolder_IsKeptUnlessOverwritten) {
  const std::string before = TextOf(path() / "data.txt");
  Overwrite(path() / "notes.txt", "mine");
  SequenceWriter writer;
  const hal::Fault fault = writer.Open(path(), "box", false);
  EXPECT_EQ(fault.status, Status::kBusy);
  EXPECT_NE(std::string(fault.message).find("not empty"), std::string::npos) << fault.message;
  EXPECT_EQ(TextOf(path() / "data.txt"), before);

  ASSERT_TRUE(writer.Open(path(), "box", true).ok());
  EXPECT_FALSE(fs::exists(depth(0)));
  EXPECT_FALSE(fs::exists(mask(0)));
  EXPECT_EQ(TextOf(path() / "notes.txt"), "mine") << "only the sequence may be removed";
}

TEST_F(RecordedSequence, FolderThatIsNoSequence_IsNotOverwrittenAndKeepsAll) {
  for (const char* name : {"cam_K.json", "data.txt"}) {
    const std::string text = TextOf(path() / name);
    fs::remove(path() / name);
    SequenceWriter writer;
    const hal::Fault fault = writer.Open(path(), "box", true);
    EXPECT_EQ(fault.status, Status::kBusy) << name;
    EXPECT_NE(std::string(fault.message).find("is no sequence"), std::string::npos)
        << fault.message;
    EXPECT_TRUE(fs::exists(depth(0)) && fs::exists(mask(0)) && fs::exists(path() / "gt")) << name;
    Overwrite(path() / name, text);
  }
}

TEST_F(RecordedSequence, SequenceWithoutAFrameYet_IsOverwritten) {
  const fs::path begun = path() / "begun";
  for (int i = 0; i < 2; ++i) {
    SequenceWriter writer;
    const hal::Fault fault = writer.Open(begun, "box", true);
    EXPECT_TRUE(fault.ok()) << fault.message;
  }
}

TEST_F(RecordedSequence, FrameOfAnotherSize_IsRefused) {
  SequenceWriter writer;
  ASSERT_TRUE(writer.Open(path(), "box", true).ok());
  Simulation usual(Options(), MakeObjectMesh(ObjectKind::kBox));
  SimulationOptions wide_options = Options();
  wide_options.width_px = 80;
  Simulation wide(wide_options, MakeObjectMesh(ObjectKind::kBox));
  DepthFrame frame;
  usual.Render(0, frame);
  ASSERT_TRUE(writer.AddFrame(frame).ok());
  wide.Render(0, frame);
  EXPECT_EQ(writer.AddFrame(frame).status, Status::kInvalidImageSize);
  EXPECT_EQ(writer.AddMask("gt", wide.gt_mask()).status, Status::kMaskSizeMismatch);
  EXPECT_EQ(writer.frame_count(), 1);
}

// A camera's pose that comes over a link is known when its first messages have arrived, and is
// missed now and then later on.
TEST_F(RecordedSequence, WorldPosesOfSomeFrames_AreReplayedWithThose) {
  for (const std::set<int>& posed :
       std::vector<std::set<int>>{{}, {0}, {2, 3, 5}, {kFrames - 1}, {0, 1, 2, 3, 4, 5}}) {
    const apps::ScratchDir dir;
    SequenceWriter writer;
    ASSERT_TRUE(writer.Open(dir.path() / "s", "box", false).ok());
    Simulation simulation(Options(), MakeObjectMesh(ObjectKind::kBox));
    for (int i = 0; i < kFrames; ++i) {
      DepthFrame frame;
      simulation.Render(i, frame);
      frame.has_T_wc = posed.count(i) > 0;
      ASSERT_TRUE(writer.AddFrame(frame).ok());
    }
    ASSERT_TRUE(writer.Finish().ok());
    EXPECT_EQ(fs::exists(dir.path() / "s" / "T_wc.txt"), !posed.empty());
    ReplayOptions replay;
    replay.dir = dir.path() / "s";
    ReplaySensor sensor(replay);
    const hal::Fault opened = sensor.Open();
    ASSERT_TRUE(opened.ok()) << opened.message;
    const std::vector<CopiedFrame> replayed = PlayAll(sensor);
    ASSERT_EQ(replayed.size(), std::size_t{kFrames});
    for (int i = 0; i < kFrames; ++i) {
      const DepthFrame& frame = replayed[static_cast<std::size_t>(i)].frame;
      ASSERT_EQ(frame.has_T_wc, posed.count(i) > 0) << "frame " << i;
      if (!frame.has_T_wc) continue;
      const Transform<World, Camera>& T_wc = frames_[static_cast<std::size_t>(i)].frame.T_wc;
      EXPECT_LT((frame.T_wc.translation() - T_wc.translation()).norm(), 1e-7F);
    }
  }
}

TEST(SequenceWriter, Z16_IsWrittenInMetres) {
  const apps::ScratchDir dir;
  SimulationOptions options;
  options.width_px = 64;
  options.height_px = 48;
  options.format = DepthFormat::kUint16;
  Simulation simulation(options, MakeObjectMesh(ObjectKind::kBox));
  DepthFrame frame;
  simulation.Render(0, frame);
  SequenceWriter writer;
  ASSERT_TRUE(writer.Open(dir.path() / "s", "box", false).ok());
  ASSERT_TRUE(writer.AddFrame(frame).ok());
  ASSERT_TRUE(writer.Finish().ok());
  ReplayOptions replay;
  replay.dir = dir.path() / "s";
  ReplaySensor sensor(replay);
  ASSERT_TRUE(sensor.Open().ok());
  DepthFrame read;
  ASSERT_TRUE(sensor.Next(0, read).ok());
  EXPECT_FALSE(read.mask.given());
  for (int v = 0; v < 48; ++v) {
    for (std::size_t u = 0; u < 64; ++u) {
      std::uint16_t raw = 0;
      float depth_m = 0.0F;
      std::memcpy(&raw, frame.depth.row(v) + 2 * u, sizeof(raw));
      std::memcpy(&depth_m, read.depth.row(v) + 4 * u, sizeof(depth_m));
      ASSERT_EQ(depth_m, static_cast<float>(raw) * 0.001F);
    }
  }
}

TEST(SequenceWriter, LargeStamps_KeepTheirNanoseconds) {
  const apps::ScratchDir dir;
  SimulationOptions options;
  options.width_px = 32;
  options.height_px = 32;
  Simulation simulation(options, MakeObjectMesh(ObjectKind::kBox));
  DepthFrame frame;
  simulation.Render(0, frame);
  constexpr StampNs kStamp_ns = 1'789'654'321'123'456'789;
  frame.stamp_ns = kStamp_ns;
  SequenceWriter writer;
  ASSERT_TRUE(writer.Open(dir.path() / "s", "box", false).ok());
  ASSERT_TRUE(writer.AddFrame(frame).ok());
  ASSERT_TRUE(writer.Finish().ok());
  ReplayOptions replay;
  replay.dir = dir.path() / "s";
  ReplaySensor sensor(replay);
  ASSERT_TRUE(sensor.Open().ok());
  ASSERT_TRUE(sensor.Next(0, frame).ok());
  EXPECT_EQ(frame.stamp_ns, kStamp_ns);
}

TEST(SequenceWriter, UsedBeforeOpen_SaysSo) {
  SequenceWriter writer;
  EXPECT_EQ(writer.AddFrame({}).status, Status::kNotOpen);
  EXPECT_EQ(writer.AddMask("gt", {}).status, Status::kNotOpen);
  EXPECT_EQ(writer.AddTruth({}).status, Status::kNotOpen);
}

TEST(SequenceWriter, FolderThatCannotBeMade_IsNamed) {
  const apps::ScratchDir dir;
  dir.Write("file", "not a folder");
  SequenceWriter writer;
  const hal::Fault fault = writer.Open(dir.path() / "file" / "below", "box", false);
  EXPECT_FALSE(fault.ok());
  EXPECT_NE(std::string(fault.message).find("below"), std::string::npos) << fault.message;
}

}  // namespace
}  // namespace disflow::host
