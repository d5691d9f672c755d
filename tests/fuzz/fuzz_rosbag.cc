// SPDX-License-Identifier: BSD-3-Clause
#include <string_view>

#include "camera_messages.h"
#include "disflow/posix/rosbag/bag_sensor.h"
#include "file_in_memory.h"

namespace {

using namespace disflow;
using fuzz::Require;

void CheckMessage(const hal::Fault& fault) {
  Require(fault.ok() == (fault.message[0] == '\0'));
  for (const char* c = fault.message; *c != '\0'; ++c) Require(*c >= ' ' && *c <= '~');
}

/// Reads every pixel: the sanitizers see what lies outside.
std::size_t SumOf(const DepthFrame& frame) {
  std::size_t sum = 0;
  for (int v = 0; v < frame.depth.height_px; ++v) {
    for (int i = 0; i < frame.depth.width_px * frame.depth.bytes_per_pixel(); ++i)
      sum += std::to_integer<std::size_t>(frame.depth.row(v)[i]);
  }
  for (int v = 0; v < frame.mask.height_px; ++v) {
    for (int u = 0; u < frame.mask.width_px; ++u)
      sum += frame.mask.data[v * frame.mask.stride_bytes + u];
  }
  return sum;
}

/// Plays it as a file of either kind.
void CheckFile(const std::uint8_t* data, std::size_t size) {
  static fuzz::FileInMemory file;
  file.Fill(data, size);
  posix::BagOptions options;
  options.path = file.path();
  options.depth_topic = "/d";
  options.info_topic = "/i";
  options.mask_topic = size % 2 == 0 ? "/m" : "";
  if (size % 4 < 2) options.world_frame.push_back('w');
  posix::BagSensor sensor(options);
  const hal::Fault opened = sensor.Open();
  CheckMessage(opened);
  if (!opened.ok()) return;
  constexpr int kMost = 1000;
  for (int i = 0; i < kMost; ++i) {
    DepthFrame frame;
    const hal::Fault fault = sensor.Next(0, frame);
    CheckMessage(fault);
    if (fault.status == Status::kEndOfStream) return;
    if (fault.ok()) Require(SumOf(frame) < ~std::size_t{0} && frame.stamp_ns > 0);
  }
}

void CheckMessages(posix::Serialization serialization, const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  std::vector<posix::RosTransform> transforms;
  CheckMessage(ReadTransforms({serialization, "tf2_msgs/msg/TFMessage", bytes}, transforms));
  const posix::BagMessage message{serialization, "sensor_msgs/msg/Image", bytes};
  StampNs stamp_ns = 0;
  posix::RosImage image;
  CheckMessage(ReadImage(message, stamp_ns, image));
  posix::CompressedImage packed;
  CheckMessage(ReadCompressedImage(message, stamp_ns, packed));
  posix::RosIntrinsics intrinsics;
  const hal::Fault fault = ReadIntrinsics(message, true, stamp_ns, intrinsics);
  CheckMessage(fault);
  if (fault.ok()) Require(intrinsics.camera.IsValid());
}

}  // namespace

/// The first byte chooses between files and messages.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  switch (data[0] % 3) {
    case 0:
      CheckFile(data + 1, size - 1);
      break;
    case 1:
      CheckMessages(posix::Serialization::kCdr, data + 1, size - 1);
      break;
    default:
      CheckMessages(posix::Serialization::kRos1, data + 1, size - 1);
      break;
  }
  return 0;
}
