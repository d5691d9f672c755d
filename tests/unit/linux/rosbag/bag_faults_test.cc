// SPDX-License-Identifier: BSD-3-Clause
#include <sys/stat.h>

#include <algorithm>
#include <cstring>

#include "bag_fixture.h"

namespace disflow::posix {
namespace {

TEST_F(BagSensorTest, BagOfRos1ThatWasCutAnywhere_PlaysItsWholeFramesAndSaysSo) {
  WriteAs(Wire::kRos1);
  const Bytes whole = Ros1Bag(messages_, "none", /*closed=*/false);
  ExpectAll(Options(dir_.Write("run.bag.active", whole)), "cut short");
  for (std::size_t size = 13; size < whole.size(); size += 97) {
    BagSensor sensor(Options(dir_.Write("cut.bag", whole.substr(0, size))));
    if (!sensor.Open().ok()) continue;
    const std::vector<Played> frames = PlayAll(sensor);
    for (std::size_t k = 0; k < frames.size(); ++k) ExpectFrame(frames[k], static_cast<int>(k));
  }
}

TEST_F(BagSensorTest, BagOfRos1WithAnyDamagedByte_GivesFramesOfTheRightSizeOrIsSaid) {
  WriteAs(Wire::kRos1);
  messages_.resize(8);
  const Bytes whole = Ros1Bag(messages_, "lz4");
  for (std::size_t at = 0; at < whole.size(); ++at) {
    if (at > 200 && at < 4100) continue;  // padding
    Bytes damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    BagSensor sensor(Options(dir_.Write("damaged.bag", damaged)));
    if (!sensor.Open().ok()) continue;
    for (const Played& played : PlayAll(sensor))
      EXPECT_TRUE(!played.fault.ok() || played.pixels.size() == PixelsOf(0).size()) << at;
  }
}

TEST_F(BagSensorTest, PipeInPlaceOfARecording_IsNamedWithoutBeingOpened) {
  const fs::path pipe = dir_.path() / "pipe.mcap";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  ExpectRefused(Options(pipe), Status::kCorrupt, "pipe.mcap: is a pipe");
}

TEST_F(BagSensorTest, ScaleOfMetres_IsRefused) {
  messages_[1].data = ImageMessage({StampOf(0), "32FC1", 4, 6, PixelsOf(0)});
  BagOptions options = Options(Write());
  options.unit_m = 0.001;
  ExpectRefused(options, Status::kUnsupported, "scale");
}

TEST_F(BagSensorTest, FileThatWasCutAnywhere_PlaysItsWholeFramesAndSaysSo) {
  for (const bool chunked : {true, false}) {
    const Bytes whole = McapFile(messages_, {.chunked = chunked, .per_chunk = 3});
    int most = 0;
    const std::size_t before_end = whole.size() - 8;
    for (std::size_t size = 0; size <= before_end;
         size = size == before_end ? size + 1 : std::min(size + 97, before_end)) {
      const fs::path file = dir_.Write("cut.mcap", whole.substr(0, size));
      BagSensor sensor(Options(file));
      const hal::Fault opened = sensor.Open();
      if (!opened.ok()) {
        EXPECT_NE(std::string(opened.message).find("cut.mcap"), std::string::npos)
            << opened.message;
        continue;
      }
      EXPECT_NE(sensor.note().find("cut short"), std::string::npos);
      const std::vector<Played> frames = PlayAll(sensor);
      for (std::size_t k = 0; k < frames.size(); ++k) {
        ASSERT_TRUE(frames[k].fault.ok()) << frames[k].fault.message;
        EXPECT_EQ(frames[k].pixels, PixelsOf(static_cast<int>(k)));
      }
      EXPECT_GE(static_cast<int>(frames.size()), most) << "more of the file holds no less";
      most = static_cast<int>(frames.size());
    }
    EXPECT_EQ(most, kFrames);
  }
}

TEST_F(BagSensorTest, RecordingThatWasNotClosed_PlaysWholly) {
  ExpectAll(Options(Write({.chunked = false, .closed = false})), "cut short");
}

TEST_F(BagSensorTest, AnyDamagedByte_GivesTheTrueFramesOrIsSaid) {
  messages_.resize(9);
  for (const char* compression : {"", "lz4", "zstd"}) {
    const Bytes whole = McapFile(messages_, {.compression = compression, .per_chunk = 3});
    for (std::size_t at = 0; at < whole.size(); at += 3) {
      Bytes damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
      const fs::path file = dir_.Write("damaged.mcap", damaged);
      BagSensor sensor(Options(file));
      if (!sensor.Open().ok()) continue;
      std::size_t good = 0;
      std::size_t faults = 0;
      for (const Played& played : PlayAll(sensor)) {
        ++(played.fault.ok() ? good : faults);
        if (!played.fault.ok()) continue;
        const auto k = static_cast<int>((played.stamp_ns - kFirst_ns) / kStep_ns);
        EXPECT_EQ(played.stamp_ns, StampOf(k)) << "byte " << at;
        EXPECT_EQ(played.pixels, PixelsOf(k)) << "byte " << at;
      }
      EXPECT_TRUE(good == 3 || faults > 0 || !sensor.note().empty()) << "byte " << at;
    }
  }
}

TEST_F(BagSensorTest, ChecksumOfAFileWithoutChunks_IsCompared) {
  Bytes file = McapFile(messages_, {.chunked = false});
  const std::size_t at = file.find(PixelsOf(4));
  ASSERT_NE(at, Bytes::npos);
  file[at] = static_cast<char>(file[at] ^ 1);
  BagSensor sensor(Options(dir_.Write("damaged.mcap", file)));
  ASSERT_TRUE(sensor.Open().ok());
  const std::vector<Played> frames = PlayAll(sensor);
  ASSERT_EQ(frames.size(), std::size_t{kFrames + 1});
  EXPECT_NE(std::string(frames.back().fault.message).find("checksum"), std::string::npos);
}

TEST_F(BagSensorTest, DamagedDatabase_NeverGivesAWrongFrameSize) {
  const fs::path file = dir_.path() / "whole.db3";
  WriteDb3(file, messages_);
  std::ifstream stream(file, std::ios::binary);
  const Bytes whole{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t at = 0; at < whole.size(); at += 131) {
    Bytes damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    BagSensor sensor(Options(dir_.Write("damaged.db3", damaged)));
    if (!sensor.Open().ok()) continue;
    for (const Played& played : PlayAll(sensor)) {
      EXPECT_TRUE(!played.fault.ok() || played.pixels.size() == PixelsOf(0).size());
    }
  }
}

TEST_F(BagSensorTest, DatabaseWhoseTablesAreViews_IsRefused) {
  const fs::path file = dir_.path() / "endless.db3";
  Execute(
      file,
      "CREATE TABLE topics(id,name,type,serialization_format);"
      "CREATE VIEW messages AS WITH RECURSIVE c(data) AS (SELECT 1 UNION ALL SELECT data+1 FROM "
      "c) SELECT 1 AS topic_id, data FROM c;");
  ExpectRefused(Options(file), Status::kUnsupported, "no recording of ROS 2");
}

TEST_F(BagSensorTest, MissingTopic_IsNamedWithThoseThatAreThere) {
  BagOptions options = Options(Write());
  options.depth_topic = "/depth";
  ExpectRefused(options, Status::kNotFound, kDepth);
  options = Options(Write());
  options.info_topic = "/info";
  ExpectRefused(options, Status::kNotFound, kInfo);
  options = Options(Write());
  options.mask_topic = "/mask";
  ExpectRefused(options, Status::kNotFound, "/mask");
}

TEST_F(BagSensorTest, WrongTypes_AreNamed) {
  BagOptions options = Options(Write());
  options.depth_topic = kInfo;
  ExpectRefused(options, Status::kUnsupported, kInfoType);
  options = Options(Write());
  options.info_topic = kDepth;
  ExpectRefused(options, Status::kUnsupported, kImageType);
  options = Options(Write());
  options.mask_topic = kDepth;
  ExpectRefused(options, Status::kUnsupported, "16UC1");
  ExpectRefused(Options(Write({.encoding = "protobuf"})), Status::kUnsupported, "protobuf");
  messages_[1].data = ImageMessage({StampOf(0), "rgb8", 8, 6, Bytes(144, 'x')});
  ExpectRefused(Options(Write()), Status::kUnsupported, "rgb8");
}

TEST_F(BagSensorTest, FramesWithoutStampOrOfAnotherKind_AreLostAlone) {
  messages_[1].data = ImageMessage({0, "16UC1", 8, 6, PixelsOf(0)});
  messages_[10].data = ImageMessage({StampOf(3), "16UC1", 4, 12, PixelsOf(3)});
  messages_[13].data = messages_[13].data.substr(0, 60);
  messages_[16].data = ImageMessage({StampOf(5), "rgb8", 8, 6, Bytes(144, 'x')});
  BagSensor sensor(Options(Write()));
  ASSERT_TRUE(sensor.Open().ok());
  const std::vector<Played> frames = PlayAll(sensor);
  ASSERT_EQ(frames.size(), std::size_t{kFrames});
  for (int k = 0; k < kFrames; ++k) {
    const Played& played = frames[static_cast<std::size_t>(k)];
    if (k != 0 && (k < 3 || k > 5)) {
      ExpectFrame(played, k);
    } else {
      EXPECT_FALSE(played.fault.ok());
      EXPECT_NE(std::string(played.fault.message).find(kDepth), std::string::npos);
    }
  }
  EXPECT_EQ(sensor.counters().corrupt, 4U);
  EXPECT_EQ(sensor.counters().frames, 6U);
}

TEST_F(BagSensorTest, FilesOfOtherKinds_AreNamedWithAWayOut) {
  ExpectRefused(Options(dir_.path() / "nothing.mcap"), Status::kNotFound, "nothing.mcap");
  ExpectRefused(Options(dir_.Write("a.db3.zstd", Zstd("x"))), Status::kUnsupported, "zstd -d");
  ExpectRefused(Options(dir_.Write("a.bag", "#ROSBAG V1.2\n")), Status::kUnsupported, "2.0");
  ExpectRefused(Options(dir_.Write("b.bag", "#ROSBAG V2.0\n")), Status::kNotFound, "b.bag");
  ExpectRefused(Options(dir_.Write("a.mcap", "text")), Status::kCorrupt, "neither MCAP nor SQLite");
  fs::create_directories(dir_.path() / "empty");
  ExpectRefused(Options(dir_.path() / "empty"), Status::kNotFound, "empty");
}

TEST_F(BagSensorTest, ChunkThatClaimsGigabytes_IsRefusedBeforeAllocation) {
  Bytes file = McapFile(messages_, {.compression = "zstd", .per_chunk = 1000});
  const std::size_t chunk = file.find('\x06', 8 + 9 + 8 + 8);
  const std::uint64_t size = std::uint64_t{1} << 40U;
  std::memcpy(file.data() + chunk + 9 + 16, &size, sizeof(size));
  ExpectRefused(Options(dir_.Write("large.mcap", file)), Status::kCorrupt, "too long");
}

}  // namespace
}  // namespace disflow::posix
