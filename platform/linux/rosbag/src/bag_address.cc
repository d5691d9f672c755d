// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/rosbag/bag_address.h"

#include <array>

#include "disflow/host/option_value.h"
#include "disflow/posix/ros/ros_camera_info.h"
#include "disflow/posix/ros/ros_transforms.h"
#include "disflow/posix/shown_text.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;
using host::Choice;

constexpr std::array kYesOrNo{Choice<bool>{"yes", true}, Choice<bool>{"no", false}};
constexpr int kMaxFrames = 100'000'000;

Fault ParseTopic(std::string_view key, std::string_view value, std::string& topic) {
  constexpr std::size_t kLongest = 255;
  if (value.size() < 2 || value.size() > kLongest || value.front() != '/' || value.back() == '/') {
    return MakeFault(Status::kInvalidUri, "%.*s=%s is no topic, e.g. /camera/depth/image_rect_raw",
                     static_cast<int>(key.size()), key.data(), ShownText(value, 64).c_str());
  }
  topic = value;
  return {};
}

Fault ParseFrame(std::string_view key, std::string_view value, std::string& frame) {
  if (value.empty() || value.size() > RosTransforms::kMaxName || value.front() == '/') {
    return MakeFault(Status::kInvalidUri, "%.*s=%s is no frame of /tf, e.g. map",
                     static_cast<int>(key.size()), key.data(), ShownText(value, 64).c_str());
  }
  frame = value;
  return {};
}

Fault SetOption(std::string_view key, std::string_view value, BagOptions& options) {
  if (key == "depth") return ParseTopic(key, value, options.depth_topic);
  if (key == "info") return ParseTopic(key, value, options.info_topic);
  if (key == "mask") return ParseTopic(key, value, options.mask_topic);
  if (key == "world") return ParseFrame(key, value, options.world_frame);
  if (key == "camera") return ParseFrame(key, value, options.camera_frame);
  if (key == "rectified") {
    return host::ParseChoice(key, value, std::span<const Choice<bool>>(kYesOrNo),
                             options.rectified.emplace());
  }
  if (key == "scale") return host::ParseNumber(key, value, 1e-7, 1.0, options.unit_m.emplace());
  if (key == "first") return host::ParseNumber(key, value, 0, kMaxFrames, options.first);
  if (key == "count") return host::ParseNumber(key, value, 1, kMaxFrames, options.count);
  return MakeFault(Status::kInvalidUri,
                   "rosbag has no option %s; known: depth, info, mask, world, camera, rectified, "
                   "scale, first, count",
                   ShownText(key, 64).c_str());
}

}  // namespace

void SetTopicDefaults(BagOptions& options) {
  // As librealsense records: /device_0/sensor_0/Depth_0/image/data. Its depth images are rectified.
  constexpr std::string_view kRealSense = "/image/data";
  const std::string& depth = options.depth_topic;
  const bool is_realsense = depth.starts_with("/device_") && depth.ends_with(kRealSense);
  if (options.info_topic.empty() && is_realsense) {
    options.info_topic = depth.substr(0, depth.size() - kRealSense.size()) + "/info/camera_info";
  }
  if (options.info_topic.empty()) options.info_topic = CameraInfoTopic(depth);
  if (!options.rectified) options.rectified = !is_realsense && IsRectifiedTopic(depth);
}

Fault ParseBagUri(const host::Uri& uri, BagOptions& options) {
  BagOptions parsed;
  parsed.path = uri.path;
  for (const auto& [key, value] : uri.query) {
    const Fault fault = SetOption(key, value, parsed);
    if (!fault.ok()) return fault;
  }
  if (!parsed.camera_frame.empty() && parsed.world_frame.empty()) {
    return MakeFault(
        Status::kInvalidUri,
        "camera= is for the camera's poses; write world=FRAME as well, e.g. world=map");
  }
  if (!parsed.depth_topic.empty()) SetTopicDefaults(parsed);
  options = parsed;
  return {};
}

}  // namespace disflow::posix
