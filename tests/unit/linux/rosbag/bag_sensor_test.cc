// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "bag_fixture.h"

namespace disflow::posix {
namespace {

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
  // The recorder was killed in the last one.
  dir_.Write("split/split_10.mcap", McapFile(messages_, {.chunked = false, .closed = false}));
  ExpectAll(Options(dir_.path() / "split"), "split_10.mcap");
}

TEST_F(BagSensorTest, MessagesOfEveryWire_AreUnderstood) {
  for (const Wire wire : {Wire::kLittle, Wire::kBig, Wire::kRos1}) {
    WriteAs(wire);
    ExpectAll(Options(Write({.encoding = wire == Wire::kRos1 ? "ros1" : "cdr"})));
  }
}

TEST_F(BagSensorTest, BagOfRos1_PlaysTheSameFrames) {
  WriteAs(Wire::kRos1);
  for (const char* compression : {"none", "lz4", "bz2"})
    ExpectAll(Options(dir_.Write("run.bag", Ros1Bag(messages_, compression))));
  ExpectRefused(Options(dir_.Write("run.bag", Ros1Bag(messages_, "snappy"))), Status::kCorrupt,
                "'snappy'");
}

TEST_F(BagSensorTest, Mono16_NeedsItsUnit) {
  for (int k = 0; k < kFrames; ++k) {
    messages_[static_cast<std::size_t>(3 * k + 1)].data =
        ImageMessage({StampOf(k), "mono16", 8, 6, PixelsOf(k)});
  }
  ExpectRefused(Options(Write()), Status::kUnsupported, "scale=");
  BagOptions options = Options(Write());
  options.unit_m = 0.00025;
  BagSensor sensor(options);
  ASSERT_TRUE(sensor.Open().ok());
  DepthFrame frame;
  ASSERT_TRUE(sensor.Next(0, frame).ok());
  EXPECT_EQ(frame.depth.unit_m, 0.00025F);
}

/// As librealsense records: intrinsics once, without a stamp.
TEST_F(BagSensorTest, IntrinsicsWithoutStamp_AreThoseOfAllFrames) {
  std::erase_if(messages_, [](const RecordedMessage& message) { return message.topic == kInfo; });
  messages_.insert(messages_.begin(), {kInfo, kInfoType, CameraInfoMessage(0, 77.0)});
  BagSensor sensor(Options(Write()));
  const hal::Fault opened = sensor.Open();
  ASSERT_TRUE(opened.ok()) << opened.message;
  const std::vector<Played> frames = PlayAll(sensor);
  ASSERT_EQ(frames.size(), std::size_t{kFrames});
  for (const Played& played : frames) EXPECT_EQ(played.fx_px, 77.0F);
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

/// Whatever byte is damaged: no frame is another than it was, and what is lost is said.
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
