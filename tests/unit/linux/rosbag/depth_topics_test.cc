// SPDX-License-Identifier: BSD-3-Clause
// Recordings whose depth images nobody has named.
#include "bag_fixture.h"

namespace disflow::posix {
namespace {

class DepthTopics : public BagSensorTest {
 protected:
  /// @return What is said of a file only.
  [[nodiscard]] static BagOptions Unnamed(const fs::path& file) {
    BagOptions options;
    options.path = file;
    return options;
  }
  void AddImage(const std::string& topic, const std::string& encoding, std::size_t pixel_bytes) {
    messages_.push_back({topic, kImageType,
                         ImageMessage({StampOf(0), encoding, 8, 6, Bytes(48 * pixel_bytes, 'x')})});
  }
  void AddInfo(const std::string& topic) {
    messages_.push_back({topic, kInfoType, CameraInfoMessage(StampOf(0), 5.0)});
  }
};

TEST_F(DepthTopics, OnlyOneWithItsIntrinsics_IsPlayedAndSaid) {
  // What else a camera sends, and depth that nobody could use.
  AddImage("/camera/color/image_raw", "rgb8", 3);
  AddInfo("/camera/color/camera_info");
  AddImage("/camera/infra1/image_rect_raw", "mono8", 1);
  AddInfo("/camera/infra1/camera_info");
  AddImage("/camera/infra2/image_rect_raw", "mono16", 2);
  AddInfo("/camera/infra2/camera_info");
  AddImage("/lonely/depth/image_rect_raw", "16UC1", 2);
  ExpectAll(Unnamed(Write()), std::string("its depth images are those of ") + kDepth);
}

TEST_F(DepthTopics, EveryKindOfFile_IsLookedThrough) {
  WriteDb3(dir_.path() / "run.db3", messages_);
  ExpectAll(Unnamed(dir_.path() / "run.db3"), kDepth);
  McapStyle killed;
  killed.chunked = false;
  killed.closed = false;
  ExpectAll(Unnamed(Write(killed)), kDepth);
  WriteAs(Wire::kRos1);
  ExpectAll(Unnamed(dir_.Write("run.bag", Ros1Bag(messages_, "lz4"))), kDepth);
}

TEST_F(DepthTopics, TopicThatBeginsInTheLastFileOfAFolder_IsFound) {
  const fs::path first = Write();
  std::vector<RecordedMessage> later;
  std::swap(later, messages_);
  AddInfo("/tf_only");
  (void)Write();
  (void)dir_.Write("bag/bag_1.mcap", McapFile(later, {}));
  ExpectAll(Unnamed(first.parent_path()), kDepth);
}

TEST_F(DepthTopics, Several_AreListedAndNoneIsChosen) {
  AddImage("/camera/aligned_depth_to_color/image_raw", "32FC1", 4);
  AddInfo("/camera/aligned_depth_to_color/camera_info");
  const fs::path file = Write();
  ExpectRefused(Unnamed(file), Status::kInvalidUri,
                "bag_0.mcap: has depth images on several topics; choose one, ?depth=TOPIC: "
                "/camera/aligned_depth_to_color/image_raw /camera/depth/image_rect_raw");
  ExpectAll(Options(file));
}

TEST_F(DepthTopics, WithoutTheirIntrinsics_AskForThem) {
  std::erase_if(messages_, [](const RecordedMessage& message) { return message.topic == kInfo; });
  ExpectRefused(Unnamed(Write()), Status::kNotFound, "of which there is none");
  for (int k = 0; k < kFrames; ++k)
    messages_.push_back({"/elsewhere/info", kInfoType, CameraInfoMessage(StampOf(k), 10.0 + k)});
  BagOptions options = Unnamed(Write());
  ExpectRefused(options, Status::kNotFound,
                "no CameraInfo beside the depth images of /camera/depth/image_rect_raw; say "
                "?info=TOPIC, of /elsewhere/info");
  options.info_topic = "/elsewhere/info";
  ExpectAll(options, kDepth);
}

TEST_F(DepthTopics, None_IsSaidWithWhatThereIs) {
  messages_.clear();
  AddImage("/camera/color/image_raw", "rgb8", 3);
  messages_.push_back({"/tf", "tf2_msgs/msg/TFMessage", "whatever"});
  ExpectRefused(Unnamed(Write()), Status::kNotFound,
                "has no depth images (16UC1, 32FC1, compressedDepth); it has "
                "/camera/color/image_raw /tf");
}

TEST_F(DepthTopics, SixteenBitsWithoutUnit_AreDepthOnceTheirUnitIsSaid) {
  messages_.clear();
  AddImage("/device_0/sensor_0/Depth_0/image/data", "mono16", 2);
  AddInfo("/device_0/sensor_0/Depth_0/info/camera_info");
  BagOptions options = Unnamed(Write());
  ExpectRefused(options, Status::kNotFound, "has no depth images");
  options.unit_m = 0.001;
  BagSensor sensor(options);
  const hal::Fault opened = sensor.Open();
  EXPECT_TRUE(opened.ok()) << opened.message;
}

}  // namespace
}  // namespace disflow::posix
