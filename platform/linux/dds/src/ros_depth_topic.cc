// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/dds/ros_depth_topic.h"

#include <cstring>

#include "disflow/posix/ros/ros_camera_info.h"
#include "disflow/posix/ros/ros_stamp.h"

namespace disflow::posix {
namespace {

/// Lends the bytes to a sequence, whose own are given back.
template <class Sequence>
void LendTo(Sequence& sequence, std::vector<std::uint8_t>& bytes) noexcept {
  if (bytes.empty() || sequence._buffer == bytes.data()) return;
  if (sequence._release) dds_free(sequence._buffer);
  Lend(bytes, sequence);
  sequence._length = 0;
}

/// Texts are kept from message to message, so nobody may fill memory with them.
void DropIfLong(char*& text) noexcept {
  constexpr std::size_t kLongest = 255;  // of a name in ROS
  if (text == nullptr || std::strlen(text) <= kLongest) return;
  dds_string_free(text);
  text = nullptr;
}

/// Takes the oldest message and reads its stamp.
/// @param text Of the message's texts the one beside its frame.
template <class Message>
bool TakeInto(RosSubscription<Message>& topic, RosSample<Message>& sample, char* Message::*text,
              std::vector<std::uint8_t>& bytes, RosDepthTopic::Image& image) {
  Message& message = sample.message;
  LendTo(message.data, bytes);
  if (!topic.TakeOne(sample)) return false;
  DropIfLong(message.header.frame_id);
  DropIfLong(message.*text);
  const ros::Time& stamp = message.header.stamp;
  image.fault = ReadRosStamp(stamp.sec, stamp.nanosec, image.stamp_ns);
  return true;
}

}  // namespace

hal::Fault RosDepthTopic::Subscribe(RosNode& node, const std::string& topic) {
  compressed_ = IsCompressedDepthTopic(topic);
  return compressed_ ? node.Subscribe(topic, RosQos::kSensorData, packed_)
                     : node.Subscribe(topic, RosQos::kSensorData, plain_);
}

bool RosDepthTopic::Take(Image& image) noexcept {
  Slot& slot = slots_[back_];
  return compressed_ ? TakePacked(slot, image) : TakePlain(slot, image);
}

bool RosDepthTopic::TakePlain(Slot& slot, Image& image) noexcept {
  if (!TakeInto(plain_, slot.plain, &ros::Image::encoding, slot.bytes, image)) return false;
  if (!image.fault.ok()) return true;
  ros::Image& message = slot.plain.message;
  image.fault = slot.decoder.Decode({.encoding = TextOf(message.encoding),
                                     .width_px = message.width,
                                     .height_px = message.height,
                                     .step_bytes = message.step,
                                     .is_big_endian = message.is_bigendian != 0,
                                     .data = {message.data._buffer, message.data._length}},
                                    image.depth);
  return true;
}

bool RosDepthTopic::TakePacked(Slot& slot, Image& image) noexcept {
  if (!TakeInto(packed_, slot.packed, &ros::CompressedImage::format, slot.bytes, image))
    return false;
  if (!image.fault.ok()) return true;
  const ros::CompressedImage& message = slot.packed.message;
  image.fault = slot.decoder.DecodeCompressed(
      TextOf(message.format), {message.data._buffer, message.data._length}, image.depth);
  return true;
}

void RosDepthTopic::FixSize(const DepthView& depth) {
  const std::size_t bytes =
      compressed_ ? RosDepthDecoder::MostCompressedBytes(depth.width_px, depth.height_px)
                  : slots_[back_].plain.message.data._length;
  for (Slot& slot : slots_) {
    slot.bytes.resize(bytes);
    slot.decoder.FixSize(depth.width_px, depth.height_px);
  }
}

}  // namespace disflow::posix
