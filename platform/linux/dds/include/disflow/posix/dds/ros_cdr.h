// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "disflow/posix/dds/ros_messages.h"

/// @file
/// Messages as they stand in recordings, without a network: CDR, little endian, with its head; and
/// their definitions, for those who read them without ROS.

namespace disflow::posix {

/// A message's type as ROS names it, and its definition as `ros2 interface show` would have it.
struct RosType {
  const char* name;
  const char* definition;
};

// clang-format off
template <class Message> [[nodiscard]] RosType RosTypeOf() noexcept;
template <> RosType RosTypeOf<ros::Image>() noexcept;
template <> RosType RosTypeOf<ros::CameraInfo>() noexcept;
template <> RosType RosTypeOf<ros::Odometry>() noexcept;
template <> RosType RosTypeOf<ros::TFMessage>() noexcept;
template <> RosType RosTypeOf<ros::DiagnosticArray>() noexcept;
template <> RosType RosTypeOf<ros::PointCloud2>() noexcept;
// clang-format on

/// @param bytes Replaced; keeps its memory from message to message.
void SerializeCdr(const ros::Image& message, std::vector<std::uint8_t>& bytes);
void SerializeCdr(const ros::CameraInfo& message, std::vector<std::uint8_t>& bytes);
void SerializeCdr(const ros::Odometry& message, std::vector<std::uint8_t>& bytes);
void SerializeCdr(const ros::TFMessage& message, std::vector<std::uint8_t>& bytes);
void SerializeCdr(const ros::DiagnosticArray& message, std::vector<std::uint8_t>& bytes);
void SerializeCdr(const ros::PointCloud2& message, std::vector<std::uint8_t>& bytes);

}  // namespace disflow::posix
