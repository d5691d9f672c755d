// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace disflow::posix {

/// @return true for a fully qualified ROS 2 name: `/part/part`, every part of letters, digits and
/// underscores, not beginning with a digit.
[[nodiscard]] bool IsRosName(std::string_view name) noexcept;

/// @return The text as one part of a ROS 2 name: what is not allowed becomes an underscore.
[[nodiscard]] std::string RosNamePart(std::string_view text);

/// The DDS topic behind a ROS 2 topic.
[[nodiscard]] std::string TopicName(std::string_view ros_name);
/// The DDS topics behind a ROS 2 service.
[[nodiscard]] std::string RequestTopicName(std::string_view ros_name);
[[nodiscard]] std::string ReplyTopicName(std::string_view ros_name);

}  // namespace disflow::posix
