// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace disflow::apps {

/// What `dds:KEY=VALUE&…` says; docs/ros2.md.
struct DdsAddress {
  std::uint32_t domain = 0;        ///< As ROS_DOMAIN_ID.
  std::string name = "disflow";    ///< Of the node; topics are /NAME/OBJECT/….
  std::string interface;           ///< Network interface or its address; empty: any.
  std::vector<std::string> peers;  ///< Hosts to look for beside multicast.
  std::string camera_frame = "camera_optical_frame";
  std::string mask_topic;    ///< Empty: no masks.
  std::string world_frame;   ///< Empty: nobody moves the camera.
  bool before_iron = false;  ///< ROS 2 Humble or older listens.
};

/// @return true for what ParseDdsAddress() is meant for.
[[nodiscard]] bool IsDdsAddress(std::string_view uri) noexcept;

/// @throws Failure kWrongUsage naming the option that is wrong and what it may be.
[[nodiscard]] DdsAddress ParseDdsAddress(const std::string& uri);

}  // namespace disflow::apps
