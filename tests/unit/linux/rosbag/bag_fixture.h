// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bag_files.h"
#include "disflow/posix/rosbag/bag_sensor.h"
#include "scratch_dir.h"

namespace disflow::posix {

namespace fs = std::filesystem;

inline constexpr const char* kDepth = "/camera/depth/image_rect_raw";
inline constexpr const char* kInfo = "/camera/depth/camera_info";
inline constexpr const char* kMask = "/segmentation/mask";
inline constexpr const char* kImageType = "sensor_msgs/msg/Image";
inline constexpr const char* kInfoType = "sensor_msgs/msg/CameraInfo";
inline constexpr std::int64_t kFirst_ns = 1'789'012'345'678'901'234;
inline constexpr std::int64_t kStep_ns = 33'333'333;
inline constexpr int kFrames = 10;

inline std::int64_t StampOf(int k) { return kFirst_ns + k * kStep_ns; }

/// The pixels of image k, of 8 x 6.
inline Bytes PixelsOf(int k) {
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
inline std::vector<Played> PlayAll(BagSensor& sensor) {
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
  /// The same messages in other bytes.
  void WriteAs(Wire wire) {
    const bool is_ros1 = wire == Wire::kRos1;
    messages_.clear();
    for (int k = 0; k < kFrames; ++k) {
      messages_.push_back({kInfo, is_ros1 ? "sensor_msgs/CameraInfo" : kInfoType,
                           CameraInfoMessage(StampOf(k), 10.0 + k, 8, 6, wire)});
      messages_.push_back({kDepth, is_ros1 ? "sensor_msgs/Image" : kImageType,
                           ImageMessage({StampOf(k), "16UC1", 8, 6, PixelsOf(k)}, wire)});
    }
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

}  // namespace disflow::posix
