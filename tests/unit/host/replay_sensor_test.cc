// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/replay_sensor.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>

#include "disflow/host/png_image.h"
#include "recorded_sequence.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

/// A recorded sequence that is damaged before it is played.
class ReplaySensorTest : public RecordedSequence {
 protected:
  /// Opening must fail with this status and name all of these.
  void ExpectRefused(Status status, const std::vector<std::string>& named,
                     const ReplayOptions& options) const {
    ReplaySensor sensor(options);
    const hal::Fault fault = sensor.Open();
    EXPECT_EQ(fault.status, status) << fault.message;
    for (const std::string& text : named) {
      EXPECT_NE(std::string(fault.message).find(text), std::string::npos)
          << "'" << fault.message << "' does not name " << text;
    }
    DepthFrame frame;
    EXPECT_EQ(sensor.Next(0, frame).status, Status::kNotOpen);
  }
  void ExpectRefused(Status status, const std::vector<std::string>& named) const {
    ExpectRefused(status, named, Replay());
  }

  /// Frame `lost` must be lost with this status, naming its file, and all others be played.
  void ExpectLost(int lost, Status status, const std::string& named) const {
    ReplaySensor sensor(Replay());
    const hal::Fault opened = sensor.Open();
    ASSERT_TRUE(opened.ok()) << opened.message;
    const std::vector<CopiedFrame> frames = PlayAll(sensor);
    ASSERT_EQ(frames.size(), static_cast<std::size_t>(kFrames));
    for (int i = 0; i < kFrames; ++i) {
      const hal::Fault& fault = frames[static_cast<std::size_t>(i)].fault;
      EXPECT_EQ(fault.status, i == lost ? status : Status::kOk) << "frame " << i << fault.message;
      if (i != lost) continue;
      EXPECT_NE(std::string(fault.message).find(named), std::string::npos) << fault.message;
    }
    EXPECT_EQ(sensor.counters().frames, static_cast<unsigned>(kFrames - 1));
    EXPECT_EQ(sensor.counters().corrupt, 1U);
  }

  /// With nobody at its other end.
  void PutPipe(const fs::path& file) const {
    fs::remove(file);
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  }

  [[nodiscard]] std::string DepthWithHeader(std::uint64_t width, std::uint64_t height) const {
    std::string bytes = TextOf(depth(2));
    const std::array<std::uint64_t, 2> size{width, height};
    std::memcpy(bytes.data(), size.data(), sizeof(size));
    return bytes;
  }
};

TEST_F(ReplaySensorTest, Info_SaysWhatIsPlayed) {
  ReplaySensor sensor(Replay());
  ASSERT_TRUE(sensor.Open().ok());
  EXPECT_EQ(sensor.info().width_px, 64);
  EXPECT_EQ(sensor.info().height_px, 48);
  EXPECT_NEAR(sensor.info().rate_hz, 30.0F, 1e-3F);
  EXPECT_NE(std::string(sensor.info().name).find("6 frames"), std::string::npos);
}

TEST_F(ReplaySensorTest, OpenedAgain_StartsAnew) {
  ReplaySensor sensor(Replay());
  ASSERT_TRUE(sensor.Open().ok());
  EXPECT_EQ(PlayAll(sensor).size(), 6U);
  sensor.Close();
  ASSERT_TRUE(sensor.Open().ok());
  EXPECT_EQ(PlayAll(sensor).size(), 6U);
  EXPECT_EQ(sensor.counters().frames, 6U);
}

TEST_F(ReplaySensorTest, FirstAndCount_ChooseAPart) {
  ReplayOptions options = Replay();
  options.first = 2;
  options.count = 3;
  ReplaySensor sensor(options);
  ASSERT_TRUE(sensor.Open().ok());
  const std::vector<CopiedFrame> frames = PlayAll(sensor);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].depth, frames_[2].depth);
  EXPECT_EQ(frames[0].frame.stamp_ns, frames_[2].frame.stamp_ns);
  options.first = 6;
  ExpectRefused(Status::kInvalidUri, {"first=6"}, options);
}

TEST_F(ReplaySensorTest, MaskSet_IsTheOneAskedFor) {
  ReplayOptions options = Replay();
  options.mask_set = "sloppy";
  ReplaySensor sloppy(options);
  ASSERT_TRUE(sloppy.Open().ok());
  const std::vector<CopiedFrame> frames = PlayAll(sloppy);
  EXPECT_NE(frames[0].mask, frames_[0].mask);
  EXPECT_EQ(frames[0].mask.size(), frames_[0].mask.size());
  options.mask_set = "none";
  ReplaySensor none(options);
  ASSERT_TRUE(none.Open().ok());
  EXPECT_TRUE(PlayAll(none)[0].mask.empty());
  options.mask_set = "mrcnn";
  ExpectRefused(Status::kNotFound, {"mrcnn", "gt, sloppy, none"}, options);
}

/// A sequence with the masks of a second object.
class TwoMasks : public ReplaySensorTest {
 protected:
  void SetUp() override {
    ReplaySensorTest::SetUp();
    for (int i = 0; i < kFrames; ++i) {
      // The right half of the image, so that it overlaps the box.
      std::vector<std::uint8_t> right(64 * 48, 0);
      for (std::size_t pixel = 0; pixel < right.size(); ++pixel)
        right[pixel] = pixel % 64 >= 32 ? 255 : 0;
      const fs::path file = path() / "masks" / "gt" / ("right_" + std::to_string(i) + ".png");
      ASSERT_TRUE(WriteGray8Png(file, right.data(), 64, 48, 64).ok());
    }
  }
  std::vector<CopiedFrame> Play(const std::string& object) {
    ReplayOptions options = Replay();
    options.object = object;
    ReplaySensor sensor(options);
    EXPECT_TRUE(sensor.Open().ok());
    return PlayAll(sensor);
  }
};

TEST_F(TwoMasks, OfBothObjects_AreOneMaskWithLabels) {
  const std::vector<CopiedFrame> frames = Play("box+right");
  ASSERT_EQ(frames.size(), std::size_t{kFrames});
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (std::size_t pixel = 0; pixel < frames[i].mask.size(); ++pixel) {
      const bool is_box = frames_[i].mask[pixel] != 0;
      const int expected = is_box ? 1 : pixel % 64 >= 32 ? 2 : 0;
      ASSERT_EQ(frames[i].mask[pixel], expected) << i << ' ' << pixel;
    }
  }
  EXPECT_EQ(Play("box")[3].mask, frames_[3].mask) << "of one object as it is";
}

TEST_F(TwoMasks, MissingOne_IsHeldAlone) {
  fs::remove(mask(2));
  const std::vector<CopiedFrame> frames = Play("right+box");
  for (std::size_t pixel = 0; pixel < frames[2].mask.size(); ++pixel) {
    const int expected = pixel % 64 >= 32 ? 1 : frames_[1].mask[pixel] != 0 ? 2 : 0;
    ASSERT_EQ(frames[2].mask[pixel], expected) << pixel;
  }
}

TEST_F(TwoMasks, WithoutAName_OrWithAWrongOne_AreRefused) {
  ReplayOptions options = Replay();
  ExpectRefused(Status::kNotFound, {"object=NAME", "box", "right"}, options);
  options.object = "box+left";
  ExpectRefused(Status::kNotFound, {"joined by +", "box", "right"}, options);
}

TEST_F(ReplaySensorTest, ValuesOfAMask_AreKeptAsLabels) {
  std::vector<std::uint8_t> labels(64 * 48, 0);
  labels[70] = 1;
  labels[71] = 2;
  labels[72] = 255;
  ASSERT_TRUE(WriteGray8Png(mask(0), labels.data(), 64, 48, 64).ok());
  ReplaySensor sensor(Replay());
  ASSERT_TRUE(sensor.Open().ok());
  EXPECT_EQ(PlayAll(sensor)[0].mask, labels);
}

TEST_F(ReplaySensorTest, MissingMask_IsHeldAndCounted) {
  fs::remove(mask(2));
  fs::remove(mask(3));
  ReplaySensor sensor(Replay());
  ASSERT_TRUE(sensor.Open().ok());
  const std::vector<CopiedFrame> frames = PlayAll(sensor);
  EXPECT_EQ(frames[2].mask, frames_[1].mask);
  EXPECT_EQ(frames[3].mask, frames_[1].mask);
  EXPECT_EQ(frames[4].mask, frames_[4].mask);
  EXPECT_EQ(sensor.held_masks(), 2);
}

TEST_F(ReplaySensorTest, MissingFirstMask_IsEmpty) {
  fs::remove(mask(0));
  ReplaySensor sensor(Replay());
  ASSERT_TRUE(sensor.Open().ok());
  const std::vector<CopiedFrame> frames = PlayAll(sensor);
  EXPECT_EQ(frames[0].mask, std::vector<std::uint8_t>(64 * 48, 0));
  EXPECT_EQ(frames[1].mask, frames_[1].mask);
}

TEST_F(ReplaySensorTest, MaskOfAnotherSize_IsDeliveredForTheTrackerToJudge) {
  ASSERT_TRUE(WriteGray8Png(mask(2), std::vector<std::uint8_t>(12, 255).data(), 4, 3, 4).ok());
  ReplaySensor sensor(Replay());
  ASSERT_TRUE(sensor.Open().ok());
  const std::vector<CopiedFrame> frames = PlayAll(sensor);
  ASSERT_TRUE(frames[2].fault.ok());
  EXPECT_EQ(CheckFrame(frames[2].frame, 640, 480), Status::kMaskSizeMismatch);
  EXPECT_EQ(frames[3].mask, frames_[3].mask);
}

TEST_F(ReplaySensorTest, MasksOfSeveralObjects_NeedAChoice) {
  fs::copy_file(mask(0), path() / "masks" / "gt" / "can_0.png");
  ExpectRefused(Status::kNotFound, {"object=", "box", "can"});
  ReplayOptions options = Replay();
  options.object = "box";
  ReplaySensor sensor(options);
  ASSERT_TRUE(sensor.Open().ok());
  EXPECT_EQ(PlayAll(sensor)[3].mask, frames_[3].mask);
  options.object = "cup";
  ExpectRefused(Status::kNotFound, {"box", "can"}, options);
}

TEST_F(ReplaySensorTest, MasksOfMoreObjectsThanHaveRoom_AreRefusedBeforeAllocation) {
  Overwrite(path() / "cam_K.json",
            R"({"width":4096,"height":4096,"fx":60,"fy":60,"cx":32,"cy":24})");
  ReplayOptions options = Replay();
  options.object = "box";
  for (const char* name : {"a", "b", "c", "d"}) {
    fs::copy_file(mask(0), path() / "masks" / "gt" / (std::string(name) + "_0.png"));
    options.object += std::string("+") + name;
  }
  ExpectRefused(Status::kImageTooLarge, {path().string(), "5 objects"}, options);
}

TEST_F(ReplaySensorTest, NumbersThatStartAtOneAndHaveZeros_AreTakenInNumericOrder) {
  for (int i = kFrames - 1; i >= 0; --i) {
    const std::string name = i + 1 == 2 ? "0002" : std::to_string(5 * i + 1);
    fs::rename(depth(i), path() / "depth" / (name + ".float.new"));
    fs::rename(mask(i), path() / "masks" / "gt" / ("box_" + name + ".png.new"));
  }
  for (const fs::path& folder : {path() / "depth", path() / "masks" / "gt"}) {
    std::vector<fs::path> files(fs::directory_iterator(folder), {});
    for (const fs::path& file : files) fs::rename(file, fs::path(file).replace_extension());
  }
  fs::remove(path() / "data.txt");
  ReplayOptions options = Replay();
  options.rate_hz = 30.0;
  ReplaySensor sensor(options);
  const hal::Fault opened = sensor.Open();
  ASSERT_TRUE(opened.ok()) << opened.message;
  const std::vector<CopiedFrame> frames = PlayAll(sensor);
  ASSERT_EQ(frames.size(), 6U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].depth, frames_[i].depth) << i;
    EXPECT_EQ(frames[i].mask, frames_[i].mask) << i;
  }
  EXPECT_EQ(frames[3].frame.stamp_ns - frames[0].frame.stamp_ns, 100'000'000);
}

TEST_F(ReplaySensorTest, MissingFolder_IsNamed) {
  ReplayOptions options = Replay();
  options.dir = path() / "nowhere";
  ExpectRefused(Status::kNotFound, {"nowhere"}, options);
}

TEST_F(ReplaySensorTest, FolderWithoutDepth_SaysWhatIsNeeded) {
  fs::remove_all(path() / "depth");
  ExpectRefused(Status::kNotFound, {"depth/*.float", "depth/*.png"});
}

TEST_F(ReplaySensorTest, MissingCamera_SaysWhatIsNeeded) {
  fs::remove(path() / "cam_K.json");
  ExpectRefused(Status::kNotFound, {"cam_K.json", "camera-intrinsics.txt", "K="});
}

TEST_F(ReplaySensorTest, BadCamera_IsNamed) {
  const auto write = [&](const char* text) { Overwrite(path() / "cam_K.json", text); };
  write("{\"width\": 64, \"hei");
  ExpectRefused(Status::kCorrupt, {"cam_K.json", "JSON"});
  write("[]");
  ExpectRefused(Status::kCorrupt, {"cam_K.json", "JSON"});
  write(R"({"width":64,"height":48,"fx":"60","fy":60,"cx":32,"cy":24})");
  ExpectRefused(Status::kCorrupt, {"cam_K.json", "fx"});
  write(R"({"width":64,"height":48,"fx":60,"fy":60,"cx":32})");
  ExpectRefused(Status::kCorrupt, {"cam_K.json", "cy"});
  write(R"({"width":64,"height":48,"fx":0,"fy":60,"cx":32,"cy":24})");
  ExpectRefused(Status::kInvalidIntrinsics, {"cam_K.json"});
  write(R"({"width":1e12,"height":48,"fx":60,"fy":60,"cx":32,"cy":24})");
  ExpectRefused(Status::kInvalidImageSize, {"cam_K.json", "width"});
}

TEST_F(ReplaySensorTest, TruncatedDepth_LosesThatFrameOnly) {
  fs::resize_file(depth(2), 1000);
  ExpectLost(2, Status::kTruncated, "2.float");
}

TEST_F(ReplaySensorTest, EmptyDepth_LosesThatFrameOnly) {
  fs::resize_file(depth(0), 0);
  ExpectLost(0, Status::kTruncated, "0.float");
}

TEST_F(ReplaySensorTest, TooLongDepth_LosesThatFrameOnly) {
  Overwrite(depth(2), TextOf(depth(2)) + "more");
  ExpectLost(2, Status::kCorrupt, "2.float");
}

TEST_F(ReplaySensorTest, MissingDepth_LosesThatFrameOnly) {
  fs::remove(depth(2));
  ExpectLost(2, Status::kCorrupt, "2.float");
}

TEST_F(ReplaySensorTest, DepthOfAnotherSize_LosesThatFrameOnlyAndTheCameraFileIsNamed) {
  Overwrite(depth(2), DepthWithHeader(48, 64));
  ExpectLost(2, Status::kCorrupt, "2.float: is 48 x 64 pixels, cam_K.json says 64 x 48");
}

TEST_F(ReplaySensorTest, PipeInPlaceOfADepthImage_IsNotOpenedAndLosesThatFrameOnly) {
  PutPipe(depth(2));
  ExpectLost(2, Status::kCorrupt, "2.float: is a pipe");
}

TEST_F(ReplaySensorTest, PipeInPlaceOfAMask_IsNotOpenedAndLosesThatFrameOnly) {
  PutPipe(mask(4));
  ExpectLost(4, Status::kCorrupt, "box_4.png: is a pipe");
}

TEST_F(ReplaySensorTest, PipeInPlaceOfATable_IsNotOpenedAndNamed) {
  for (const char* name : {"cam_K.json", "data.txt", "T_wc.txt"}) {
    const std::string text = TextOf(path() / name);
    PutPipe(path() / name);
    ExpectRefused(Status::kCorrupt, {name, "is a pipe"});
    fs::remove(path() / name);
    Overwrite(path() / name, text);
  }
}

TEST_F(ReplaySensorTest, DepthOfZeroSize_LosesThatFrameOnly) {
  Overwrite(depth(2), DepthWithHeader(0, 0));
  ExpectLost(2, Status::kCorrupt, "2.float");
}

TEST_F(ReplaySensorTest, DepthOfAbsurdSize_LosesThatFrameOnly) {
  // The product of both wraps around to the file's real number of pixels.
  Overwrite(depth(2), DepthWithHeader(std::uint64_t{1} << 62U, std::uint64_t{1} << 62U));
  ExpectLost(2, Status::kCorrupt, "2.float");
}

TEST_F(ReplaySensorTest, TruncatedMask_LosesThatFrameOnly) {
  fs::resize_file(mask(4), fs::file_size(mask(4)) / 2);
  ExpectLost(4, Status::kCorrupt, "box_4.png");
}

TEST_F(ReplaySensorTest, MaskThatIsNoImage_LosesThatFrameOnly) {
  Overwrite(mask(4), "text");
  ExpectLost(4, Status::kCorrupt, "box_4.png");
}

TEST_F(ReplaySensorTest, BadStamps_AreNamedWithTheirLine) {
  const auto write = [&](const char* text) { Overwrite(path() / "data.txt", text); };
  write("0 1.0\n1 soon\n2 3\n3 4\n4 5\n5 6\n");
  ExpectRefused(Status::kCorrupt, {"data.txt:2"});
  write("0 1.0\n1\n2 3\n3 4\n4 5\n5 6\n");
  ExpectRefused(Status::kCorrupt, {"data.txt:2"});
  write("0 1\n1 -2\n2 3\n3 4\n4 5\n5 6\n");
  ExpectRefused(Status::kCorrupt, {"data.txt:2"});
  write("0 1\n1 1e300\n2 3\n3 4\n4 5\n5 6\n");
  ExpectRefused(Status::kCorrupt, {"data.txt:2"});
  write("0 1\n1 2\n2 3\n");
  ExpectRefused(Status::kCorrupt, {"data.txt", "3.float"});
}

TEST_F(ReplaySensorTest, StampsThatRunBackwards_AreDeliveredForTheTrackerToJudge) {
  Overwrite(path() / "data.txt", "0 1\n1 2\n2 1.5\n3 4\n4 4\n5 6\n");
  ReplaySensor sensor(Replay());
  ASSERT_TRUE(sensor.Open().ok());
  const std::vector<CopiedFrame> frames = PlayAll(sensor);
  EXPECT_EQ(frames[2].frame.stamp_ns, 1'500'000'000);
  EXPECT_EQ(frames[4].frame.stamp_ns, 4'000'000'000);
}

TEST_F(ReplaySensorTest, WorldPosesOfAnotherLengthOrKind_AreNamed) {
  const std::string whole = TextOf(path() / "T_wc.txt");
  Overwrite(path() / "T_wc.txt", whole + "0 0 0 0 0 1 0\n");
  ExpectRefused(Status::kCorrupt, {"T_wc.txt", "7", "6"});
  Overwrite(path() / "T_wc.txt", whole.substr(0, whole.size() - 30) + "\n");
  ExpectRefused(Status::kCorrupt, {"T_wc.txt:6"});
  Overwrite(path() / "T_wc.txt", "0 0 0 0 0 5 1\n" + whole.substr(whole.find('\n') + 1));
  ExpectRefused(Status::kCorrupt, {"T_wc.txt:1", "unit length"});
  ReplayOptions options = Replay();
  options.world_poses = WorldPoses::kNone;
  ReplaySensor sensor(options);
  ASSERT_TRUE(sensor.Open().ok()) << "what is not asked for is not read";
  EXPECT_FALSE(PlayAll(sensor)[0].frame.has_T_wc);
}

TEST_F(ReplaySensorTest, ScaleForMetricDepth_IsRefused) {
  ReplayOptions options = Replay();
  options.unit_m = 0.001;
  ExpectRefused(Status::kInvalidUri, {"scale"}, options);
}

}  // namespace
}  // namespace disflow::host
