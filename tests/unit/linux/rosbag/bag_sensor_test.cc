// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/rosbag/bag_sensor.h"

#include <gtest/gtest.h>

#include <cstring>

#include "bag_files.h"
#include "scratch_dir.h"

namespace disflow::posix {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDepth = "/camera/depth/image_rect_raw";
constexpr const char* kInfo = "/camera/depth/camera_info";
constexpr const char* kMask = "/segmentation/mask";
constexpr const char* kImageType = "sensor_msgs/msg/Image";
constexpr const char* kInfoType = "sensor_msgs/msg/CameraInfo";
constexpr std::int64_t kFirst_ns = 1'789'012'345'678'901'234;
constexpr std::int64_t kStep_ns = 33'333'333;
constexpr int kFrames = 10;

std::int64_t StampOf(int k) { return kFirst_ns + k * kStep_ns; }

/// The pixels of image k, of 8 x 6.
Bytes PixelsOf(int k) {
  Bytes data;
  for (int i = 0; i < 48; ++i) {
    const auto value = static_cast<std::uint16_t>(1000 * k + i + 1);
    data += static_cast<char>(value & 0xFFU);
    data += static_cast<char>(value >> 8U);
  }
  return data;
}

/// A frame as it was delivered.
struct Played {
  hal::Fault fault;
  std::int64_t stamp_ns = 0;
  Bytes pixels;
  float fx_px = 0.0F;
  Bytes mask;
};

/// Everything until the end.
std::vector<Played> PlayAll(BagSensor& sensor) {
  std::vector<Played> all;
  DepthFrame frame;
  for (;;) {
    Played played;
    played.fault = sensor.Next(0, frame);
    if (played.fault.status == Status::kEndOfStream || played.fault.status == Status::kNotOpen)
      return all;
    if (played.fault.ok()) {
      played.stamp_ns = frame.stamp_ns;
      played.fx_px = frame.camera.fx_px;
      for (int v = 0; v < frame.depth.height_px; ++v) {
        played.pixels.append(
            reinterpret_cast<const char*>(frame.depth.row(v)),
            static_cast<std::size_t>(frame.depth.width_px * frame.depth.bytes_per_pixel()));
      }
      if (frame.mask.given()) {
        played.mask.assign(reinterpret_cast<const char*>(frame.mask.data),
                           static_cast<std::size_t>(frame.mask.width_px * frame.mask.height_px));
      }
    }
    all.push_back(std::move(played));
  }
}

class BagSensorTest : public testing::Test {
 protected:
  BagSensorTest() {
    for (int k = 0; k < kFrames; ++k) {
      messages_.push_back({"/tf", "tf2_msgs/msg/TFMessage", "whatever"});
      messages_.push_back(
          {kDepth, kImageType, ImageMessage({StampOf(k), "16UC1", 8, 6, PixelsOf(k)})});
      // Behind its image, as drivers send it.
      messages_.push_back({kInfo, kInfoType, CameraInfoMessage(StampOf(k), 10.0 + k)});
    }
  }

  [[nodiscard]] BagOptions Options(const fs::path& file) const {
    BagOptions options;
    options.path = file;
    options.depth_topic = kDepth;
    options.info_topic = kInfo;
    options.rectified = true;
    return options;
  }
  [[nodiscard]] fs::path Write(const McapStyle& style = {}) const {
    return dir_.Write("bag/bag_0.mcap", McapFile(messages_, style));
  }
  static void ExpectAll(const BagOptions& options, const std::string& note = "") {
    BagSensor sensor(options);
    const hal::Fault opened = sensor.Open();
    ASSERT_TRUE(opened.ok()) << opened.message;
    EXPECT_EQ(sensor.info().width_px, 8);
    EXPECT_EQ(sensor.info().height_px, 6);
    const std::vector<Played> frames = PlayAll(sensor);
    ASSERT_EQ(frames.size(), std::size_t{kFrames});
    for (int k = 0; k < kFrames; ++k) ExpectFrame(frames[static_cast<std::size_t>(k)], k);
    EXPECT_NE(sensor.note().find(note), std::string::npos) << sensor.note();
    EXPECT_EQ(sensor.note().empty(), note.empty()) << sensor.note();
  }
  static void ExpectFrame(const Played& played, int k) {
    ASSERT_TRUE(played.fault.ok()) << played.fault.message;
    EXPECT_EQ(played.stamp_ns, StampOf(k));
    EXPECT_EQ(played.pixels, PixelsOf(k));
    EXPECT_EQ(played.fx_px, 10.0F + static_cast<float>(k)) << "the intrinsics of the same moment";
    EXPECT_TRUE(played.mask.empty());
  }
  static void ExpectRefused(const BagOptions& options, Status status, const std::string& named) {
    const hal::Fault fault = BagSensor(options).Open();
    EXPECT_EQ(fault.status, status) << fault.message;
    EXPECT_NE(std::string(fault.message).find(named), std::string::npos) << fault.message;
  }

  apps::ScratchDir dir_;
  std::vector<RecordedMessage> messages_;
};

TEST_F(BagSensorTest, EveryWayToWriteMcap_PlaysTheSameFrames) {
  for (const bool chunked : {true, false}) {
    for (const char* compression : {"", "lz4", "zstd"}) {
      for (const bool checksums : {true, false}) {
        SCOPED_TRACE(std::string(chunked ? "chunks " : "no chunks ") + compression);
        ExpectAll(Options(
            Write({.chunked = chunked, .compression = compression, .checksums = checksums})));
      }
    }
  }
}

TEST_F(BagSensorTest, Database_PlaysTheSameFrames) {
  const fs::path file = dir_.path() / "bag_0.db3";
  WriteDb3(file, messages_);
  ExpectAll(Options(file));
}

TEST_F(BagSensorTest, MessagesPackedByThemselves_AreUnpacked) {
  for (RecordedMessage& message : messages_) message.data = Zstd(message.data);
  ExpectAll(Options(Write()));
  const fs::path file = dir_.path() / "bag_0.db3";
  WriteDb3(file, messages_);
  ExpectAll(Options(file));
}

TEST_F(BagSensorTest, FolderOfSeveralFiles_IsPlayedInTheirOrder) {
  const std::vector<RecordedMessage> all = messages_;
  fs::create_directories(dir_.path() / "split");
  for (int part = 0; part < 11; ++part) {
    const auto begin = std::min<std::size_t>(all.size(), static_cast<std::size_t>(part) * 3);
    const auto end = std::min<std::size_t>(all.size(), begin + 3);
    messages_.assign(all.begin() + static_cast<std::ptrdiff_t>(begin),
                     all.begin() + static_cast<std::ptrdiff_t>(end));
    dir_.Write("split/split_" + std::to_string(part) + ".mcap", McapFile(messages_, {}));
  }
  dir_.Write("split/metadata.yaml", "rosbag2_bagfile_information:\n");
  ExpectAll(Options(dir_.path() / "split"));
}

TEST_F(BagSensorTest, MessagesOfEveryWire_AreUnderstood) {
  for (const Wire wire : {Wire::kLittle, Wire::kBig, Wire::kRos1}) {
    const bool is_ros1 = wire == Wire::kRos1;
    messages_.clear();
    for (int k = 0; k < kFrames; ++k) {
      messages_.push_back({kInfo, is_ros1 ? "sensor_msgs/CameraInfo" : kInfoType,
                           CameraInfoMessage(StampOf(k), 10.0 + k, 8, 6, wire)});
      messages_.push_back({kDepth, is_ros1 ? "sensor_msgs/Image" : kImageType,
                           ImageMessage({StampOf(k), "16UC1", 8, 6, PixelsOf(k)}, wire)});
    }
    ExpectAll(Options(Write({.encoding = is_ros1 ? "ros1" : "cdr"})));
  }
}

TEST_F(BagSensorTest, FirstAndCount_CutOutAPart) {
  BagOptions options = Options(Write());
  options.first = 3;
  options.count = 4;
  BagSensor sensor(options);
  ASSERT_TRUE(sensor.Open().ok());
  const std::vector<Played> frames = PlayAll(sensor);
  ASSERT_EQ(frames.size(), 4U);
  ExpectFrame(frames[0], 3);
  ExpectFrame(frames[3], 6);
}

TEST_F(BagSensorTest, Masks_AreTheNewestThatAreNotYoungerThanTheFrame) {
  const auto add = [this](int k, std::int64_t later_ns, char value) {
    messages_.push_back({kMask, kImageType,
                         ImageMessage({StampOf(k) + later_ns, "mono8", 8, 6, Bytes(48, value)})});
  };
  add(2, 0, 'a');
  add(4, 1, 'b');
  BagOptions options = Options(Write());
  options.mask_topic = kMask;
  BagSensor sensor(options);
  const hal::Fault opened = sensor.Open();
  ASSERT_TRUE(opened.ok()) << opened.message;
  const std::vector<Played> frames = PlayAll(sensor);
  ASSERT_EQ(frames.size(), std::size_t{kFrames});
  const char wanted[] = {'\0', '\0', 'a', 'a', 'a', 'b', 'b', 'b', 'b', 'b'};
  for (std::size_t k = 0; k < frames.size(); ++k)
    EXPECT_EQ(frames[k].mask, Bytes(48, wanted[k])) << k;
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

/// Whatever byte is damaged: no frame is another than it was, and what is lost is said.
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
  ExpectRefused(Options(dir_.Write("a.bag", "#ROSBAG V2.0\n")), Status::kUnsupported, "ROS 1");
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

TEST_F(BagSensorTest, OpenedAnew_PlaysFromTheStart) {
  BagSensor sensor(Options(Write()));
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(sensor.Open().ok());
    EXPECT_EQ(PlayAll(sensor).size(), std::size_t{kFrames});
    sensor.Close();
    DepthFrame frame;
    EXPECT_EQ(sensor.Next(0, frame).status, Status::kNotOpen);
  }
}

}  // namespace
}  // namespace disflow::posix
