// SPDX-License-Identifier: BSD-3-Clause
#include "camera_messages.h"

#include "disflow/posix/ros/ros_stamp.h"
#include "disflow/posix/shown_text.h"

namespace disflow::posix {
namespace {

using hal::Fault;

/// std_msgs/Header.
Fault ReadHeader(MessageReader& reader, StampNs& stamp_ns, std::string_view& frame) {
  if (reader.is_ros1()) (void)reader.Take<std::uint32_t>();  // a number of the sender's own
  const auto sec = reader.Take<std::uint32_t>();
  const auto nanosec = reader.Take<std::uint32_t>();
  frame = reader.TakeText();
  return ReadRosStamp(static_cast<std::int32_t>(sec), nanosec, stamp_ns);
}

Fault ReadHeader(MessageReader& reader, StampNs& stamp_ns) {
  std::string_view frame;
  return ReadHeader(reader, stamp_ns, frame);
}

Fault Judge(const MessageReader& reader, const BagMessage& message, const Fault& stamp) {
  if (reader.ok()) return stamp;
  return hal::MakeFault(Status::kTruncated, "a message of %zu bytes is no whole %.*s",
                        message.data.size(), static_cast<int>(message.type.size()),
                        message.type.data());
}

bool IsType(std::string_view type, std::string_view package, std::string_view name) noexcept {
  if (!type.starts_with(package)) return false;
  type.remove_prefix(package.size());
  if (type.starts_with("msg/")) type.remove_prefix(4);
  return type == name;
}

}  // namespace

bool IsSensorType(std::string_view type, std::string_view name) noexcept {
  return IsType(type, "sensor_msgs/", name);
}

std::string_view ReadFrameName(const BagMessage& message) {
  MessageReader reader(message.serialization, message.data);
  StampNs stamp_ns = 0;
  std::string_view frame;
  (void)ReadHeader(reader, stamp_ns, frame);
  return reader.ok() ? frame : std::string_view();
}

Fault ReadTransforms(const BagMessage& message, std::vector<RosTransform>& transforms) {
  transforms.clear();
  if (!IsType(message.type, "tf2_msgs/", "TFMessage") &&
      !IsType(message.type, "tf/", "tfMessage")) {
    return hal::MakeFault(Status::kCorrupt, "is of type %s; tf2_msgs/msg/TFMessage is needed",
                          ShownText(message.type, 64).c_str());
  }
  MessageReader reader(message.serialization, message.data);
  const auto count = reader.Take<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && reader.ok(); ++i) {
    RosTransform transform;
    const Fault stamp = ReadHeader(reader, transform.ros_ns, transform.parent);
    transform.child = reader.TakeText();
    std::array<double, 7> numbers{};
    reader.TakeAll(numbers);
    const auto& [x_m, y_m, z_m, qx, qy, qz, qw] = numbers;
    transform.translation_m = {x_m, y_m, z_m};
    transform.rotation = {qw, qx, qy, qz};
    // Fixed ones need no stamp.
    if (!stamp.ok()) transform.ros_ns = 0;
    if (reader.ok()) transforms.push_back(transform);
  }
  return Judge(reader, message, {});
}

Fault ReadImage(const BagMessage& message, StampNs& stamp_ns, RosImage& image) {
  MessageReader reader(message.serialization, message.data);
  const Fault stamp = ReadHeader(reader, stamp_ns);
  image.height_px = reader.Take<std::uint32_t>();
  image.width_px = reader.Take<std::uint32_t>();
  image.encoding = reader.TakeText();
  image.is_big_endian = reader.Take<std::uint8_t>() != 0;
  image.step_bytes = reader.Take<std::uint32_t>();
  image.data = reader.TakeByteSequence();
  return Judge(reader, message, stamp);
}

Fault ReadCompressedImage(const BagMessage& message, StampNs& stamp_ns, CompressedImage& image) {
  MessageReader reader(message.serialization, message.data);
  const Fault stamp = ReadHeader(reader, stamp_ns);
  image.format = reader.TakeText();
  image.data = reader.TakeByteSequence();
  return Judge(reader, message, stamp);
}

Fault ReadIntrinsics(const BagMessage& message, bool rectified, StampNs& stamp_ns,
                     RosIntrinsics& intrinsics) {
  MessageReader reader(message.serialization, message.data);
  const Fault stamp = ReadHeader(reader, stamp_ns);
  const auto height_px = reader.Take<std::uint32_t>();
  const auto width_px = reader.Take<std::uint32_t>();
  const std::string_view model = reader.TakeText();
  std::array<double, 32> d{};
  const auto coefficients = reader.Take<std::uint32_t>();
  if (coefficients > d.size()) {
    return hal::MakeFault(Status::kCorrupt, "%u coefficients of distortion are no lens'",
                          coefficients);
  }
  for (std::size_t i = 0; i < coefficients; ++i) d[i] = reader.Take<double>();
  std::array<double, 9> k{};
  std::array<double, 9> r{};
  std::array<double, 12> p{};
  reader.TakeAll(k);
  reader.TakeAll(r);
  reader.TakeAll(p);
  RosCameraInfo info{.width_px = width_px,
                     .height_px = height_px,
                     .distortion_model = model,
                     .d = std::span(d).first(coefficients),
                     .k = k,
                     .p = p};
  info.binning_x = reader.Take<std::uint32_t>();
  info.binning_y = reader.Take<std::uint32_t>();
  info.roi_x_px = reader.Take<std::uint32_t>();
  info.roi_y_px = reader.Take<std::uint32_t>();
  info.roi_height_px = reader.Take<std::uint32_t>();
  info.roi_width_px = reader.Take<std::uint32_t>();
  (void)reader.Take<std::uint8_t>();  // whether somebody should rectify
  // Intrinsics without a time hold from the start.
  if (!stamp.ok()) stamp_ns = 0;
  Fault fault = Judge(reader, message, {});
  if (fault.ok()) fault = ReadCameraInfo(info, rectified, intrinsics);
  return fault;
}

}  // namespace disflow::posix
