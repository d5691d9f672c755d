// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace disflow::apps {

/// Who this program is to ROS 2, and on which network.
struct DdsNodeAddress {
  std::uint32_t domain = 0;        ///< Where the address says nothing, ROS_DOMAIN_ID.
  std::string name = "disflow";    ///< Of the node; topics are NAMESPACE/NAME/OBJECT/….
  std::string node_namespace;      ///< "/robot1"; empty: none.
  std::string interface;           ///< Network interface or its address; empty: any.
  std::vector<std::string> peers;  ///< Hosts to look for beside multicast.
  bool before_iron = false;        ///< ROS 2 Humble or older listens.

  [[nodiscard]] std::string FullName() const { return node_namespace + "/" + name; }
};

/// What `--link dds:KEY=VALUE&…` says; docs/ros2.md.
struct DdsAddress : DdsNodeAddress {
  std::string camera_frame = "camera_optical_frame";
  std::string mask_topic;   ///< Empty: no masks.
  std::string world_frame;  ///< Empty: nobody moves the camera.
  bool may_reset = false;   ///< Whoever is on the network may start the objects anew,
  bool may_choose = false;  ///< say what they are,
  bool may_set = false;     ///< change their settings as the node's parameters,
  bool may_pause = false;   ///< and pause them as the node's life cycle.
};

/// What `--sensor dds:KEY=VALUE&…` says; docs/ros2.md.
struct DdsSensorAddress : DdsNodeAddress {
  std::string depth_topic;
  std::string info_topic;         ///< Empty: camera_info beside the depth topic.
  std::optional<bool> rectified;  ///< Nothing: by the depth topic's name.
  std::uint32_t wait_s = 30;      ///< For the first image.
};

/// @return true for what the functions below are meant for.
[[nodiscard]] bool IsDdsAddress(std::string_view uri) noexcept;

/// @throws Failure kWrongUsage naming the option that is wrong and what it may be.
[[nodiscard]] DdsAddress ParseDdsAddress(const std::string& uri);
/// @throws Failure kWrongUsage naming the option that is wrong or missing and what it may be.
[[nodiscard]] DdsSensorAddress ParseDdsSensorAddress(const std::string& uri);

/// The node that a sensor is part of: a link in the same domain belongs to it too, and what only
/// one of them says holds for both.
/// @param link_uri Empty: none.
/// @throws Failure kWrongUsage naming what they say differently.
[[nodiscard]] DdsNodeAddress SensorNode(const DdsSensorAddress& sensor,
                                        const std::string& link_uri);

/// The sensor's scheme and options, for --help.
extern const char* const kDdsSensorHelp;

}  // namespace disflow::apps
