// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/dds/ros_cdr.h"

#include <array>
#include <bit>
#include <cstring>
#include <span>

namespace disflow::posix {
namespace {

static_assert(std::endian::native == std::endian::little, "values are copied as they are");

/// Of representation (plain, little endian) and options; alignment counts from behind it.
constexpr std::array<std::uint8_t, 4> kHead{0, 1, 0, 0};

class CdrBuffer {
 public:
  explicit CdrBuffer(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {
    bytes_.assign(kHead.begin(), kHead.end());
  }

  template <class T>
  requires std::is_arithmetic_v<T>
  void Put(T value) {
    const std::size_t behind_head = bytes_.size() - kHead.size();
    const std::size_t aligned = (behind_head + sizeof(T) - 1) / sizeof(T) * sizeof(T);
    bytes_.resize(kHead.size() + aligned + sizeof(T));
    std::memcpy(bytes_.data() + kHead.size() + aligned, &value, sizeof(T));
  }
  void Put(const char* text) {
    const std::string_view characters = TextOf(text);
    Put(static_cast<std::uint32_t>(characters.size() + 1));
    bytes_.insert(bytes_.end(), characters.begin(), characters.end());
    bytes_.push_back(0);
  }
  template <class T, std::size_t kCount>
  void Put(const T (&values)[kCount]) {
    for (const T& value : values) Put(value);
  }
  void PutBytes(const std::uint8_t* bytes, std::uint32_t count) {
    Put(count);
    bytes_.insert(bytes_.end(), bytes, bytes + count);
  }
  template <class Sequence>
  void PutSequence(const Sequence& sequence) {
    Put(sequence._length);
    for (const auto& element : std::span(sequence._buffer, sequence._length)) Put(element);
  }

  void Put(const ros::Header& header) {
    Put(header.stamp.sec);
    Put(header.stamp.nanosec);
    Put(header.frame_id);
  }
  void Put(const ros::Vector3& v) { PutXyz(v); }
  void Put(const ros::Quaternion& q) {
    PutXyz(q);
    Put(q.w);
  }
  void Put(const ros::Pose& pose) {
    PutXyz(pose.position);
    Put(pose.orientation);
  }
  void Put(const ros::TransformStamped& transform) {
    Put(transform.header);
    Put(transform.child_frame_id);
    Put(transform.transform.translation);
    Put(transform.transform.rotation);
  }
  void Put(const ros::KeyValue& pair) {
    Put(pair.key);
    Put(pair.value);
  }
  void Put(const ros::PointField& field) {
    Put(field.name);
    Put(field.offset);
    Put(field.datatype);
    Put(field.count);
  }
  void Put(const ros::DiagnosticStatus& status) {
    Put(status.level);
    Put(status.name);
    Put(status.message);
    Put(status.hardware_id);
    PutSequence(status.values);
  }

 private:
  template <class Xyz>
  void PutXyz(const Xyz& v) {
    Put(v.x);
    Put(v.y);
    Put(v.z);
  }

  std::vector<std::uint8_t>& bytes_;
};

}  // namespace

void SerializeCdr(const ros::Image& message, std::vector<std::uint8_t>& bytes) {
  CdrBuffer cdr(bytes);
  cdr.Put(message.header);
  cdr.Put(message.height);
  cdr.Put(message.width);
  cdr.Put(message.encoding);
  cdr.Put(message.is_bigendian);
  cdr.Put(message.step);
  cdr.PutBytes(message.data._buffer, message.data._length);
}

void SerializeCdr(const ros::CameraInfo& message, std::vector<std::uint8_t>& bytes) {
  CdrBuffer cdr(bytes);
  cdr.Put(message.header);
  cdr.Put(message.height);
  cdr.Put(message.width);
  cdr.Put(message.distortion_model);
  cdr.PutSequence(message.d);
  cdr.Put(message.k);
  cdr.Put(message.r);
  cdr.Put(message.p);
  cdr.Put(message.binning_x);
  cdr.Put(message.binning_y);
  cdr.Put(message.roi.x_offset);
  cdr.Put(message.roi.y_offset);
  cdr.Put(message.roi.height);
  cdr.Put(message.roi.width);
  cdr.Put(message.roi.do_rectify);
}

void SerializeCdr(const ros::Odometry& message, std::vector<std::uint8_t>& bytes) {
  CdrBuffer cdr(bytes);
  cdr.Put(message.header);
  cdr.Put(message.child_frame_id);
  cdr.Put(message.pose.pose);
  cdr.Put(message.pose.covariance);
  cdr.Put(message.twist.twist.linear);
  cdr.Put(message.twist.twist.angular);
  cdr.Put(message.twist.covariance);
}

void SerializeCdr(const ros::TFMessage& message, std::vector<std::uint8_t>& bytes) {
  CdrBuffer(bytes).PutSequence(message.transforms);
}

void SerializeCdr(const ros::DiagnosticArray& message, std::vector<std::uint8_t>& bytes) {
  CdrBuffer cdr(bytes);
  cdr.Put(message.header);
  cdr.PutSequence(message.status);
}

void SerializeCdr(const ros::PointCloud2& message, std::vector<std::uint8_t>& bytes) {
  CdrBuffer cdr(bytes);
  cdr.Put(message.header);
  cdr.Put(message.height);
  cdr.Put(message.width);
  cdr.PutSequence(message.fields);
  cdr.Put(message.is_bigendian);
  cdr.Put(message.point_step);
  cdr.Put(message.row_step);
  cdr.PutBytes(message.data._buffer, message.data._length);
  cdr.Put(message.is_dense);
}

}  // namespace disflow::posix
