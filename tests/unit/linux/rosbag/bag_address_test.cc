// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/rosbag/bag_address.h"

#include <gtest/gtest.h>

namespace disflow::posix {
namespace {

hal::Fault Parse(const std::string& text, BagOptions& options) {
  host::Uri uri;
  const hal::Fault fault = host::ParseUri(text, uri);
  return fault.ok() ? ParseBagUri(uri, options) : fault;
}

TEST(BagAddress, EveryKey_ReachesItsField) {
  BagOptions options;
  const hal::Fault fault = Parse(
      "rosbag:/data/run "
      "1?depth=/d/image&info=/d/info&mask=/"
      "m&world=map&camera=eye&rectified=yes&scale=0.0001&first=3&count=20",
      options);
  ASSERT_TRUE(fault.ok()) << fault.message;
  EXPECT_EQ(options.path, "/data/run 1");
  EXPECT_EQ(options.depth_topic, "/d/image");
  EXPECT_EQ(options.info_topic, "/d/info");
  EXPECT_EQ(options.mask_topic, "/m");
  EXPECT_EQ(options.world_frame, "map");
  EXPECT_EQ(options.camera_frame, "eye");
  EXPECT_EQ(options.rectified, true);
  EXPECT_EQ(options.unit_m, 0.0001);
  EXPECT_EQ(options.first, 3);
  EXPECT_EQ(options.count, 20);
}

TEST(BagAddress, WhatIsNotSaid_FollowsFromTheDepthTopic) {
  BagOptions options;
  ASSERT_TRUE(
      Parse("rosbag:run.mcap?depth=/camera/depth/image_rect_raw/compressedDepth", options).ok());
  EXPECT_EQ(options.info_topic, "/camera/depth/camera_info");
  EXPECT_EQ(options.rectified, true);
  ASSERT_TRUE(Parse("rosbag:run.mcap?depth=/camera/depth/image_raw", options).ok());
  EXPECT_EQ(options.rectified, false);
  ASSERT_TRUE(Parse("rosbag:d.bag?depth=/device_0/sensor_0/Depth_0/image/data", options).ok());
  EXPECT_EQ(options.info_topic, "/device_0/sensor_0/Depth_0/info/camera_info");
  EXPECT_EQ(options.rectified, false);
}

TEST(BagAddress, WithoutDepthTopic_NothingFollowsUntilOneIsFound) {
  BagOptions options;
  ASSERT_TRUE(Parse("rosbag:run.mcap", options).ok());
  EXPECT_EQ(options.path, "run.mcap");
  EXPECT_EQ(options.depth_topic, "");
  EXPECT_EQ(options.info_topic, "");
  EXPECT_FALSE(options.rectified.has_value());
}

TEST(BagAddress, WrongOnes_AreNamedAndChangeNothing) {
  for (const auto& [text, named] :
       {std::pair("rosbag:x?depth=image", "depth=image"), std::pair("rosbag:x?depth=/", "no topic"),
        std::pair("rosbag:x?depth=/a/", "no topic"),
        std::pair("rosbag:x?depth=/a&rectified=1", "rectified"),
        std::pair("rosbag:x?depth=/a&count=0", "count"),
        std::pair("rosbag:x?depth=/a&world=", "world"),
        std::pair("rosbag:x?depth=/a&camera=eye", "world=FRAME"),
        std::pair("rosbag:x?depth=/a&topic=/b", "topic")}) {
    BagOptions options;
    const hal::Fault fault = Parse(text, options);
    EXPECT_EQ(fault.status, Status::kInvalidUri);
    EXPECT_NE(std::string(fault.message).find(named), std::string::npos) << fault.message;
    EXPECT_TRUE(options.path.empty());
  }
}

}  // namespace
}  // namespace disflow::posix
