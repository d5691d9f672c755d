// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "settings/dds_address.h"
#include "settings/options.h"

namespace disflow::apps {

/// What `ros2 run` and launch files hand to a program behind `--ros-args`, as far as there is
/// something here that it means.
struct RosArguments {
  /// `-r OPTION:=TOPIC`: the option of a dds: address that names a topic.
  struct Topic {
    std::string option;
    std::string topic;
  };

  std::string name;                     ///< `-r __node:=NAME`; empty: not said.
  std::string node_namespace;           ///< `-r __ns:=/NAMESPACE`; empty: not said.
  std::vector<Topic> topics;            ///< In their order; the last of an option holds.
  std::vector<std::string> parameters;  ///< `-p`, NAME:=VALUE each.
};

/// Takes it out of a command line. What is no word of ROS's stays there, wherever it stands.
/// @throws Failure kWrongUsage naming the argument that means nothing here, and what would.
[[nodiscard]] RosArguments TakeRosArguments(std::vector<std::string>& arguments);

/// Puts names and topics into the dds: addresses of sensor and links, over what stands there; more
/// than once is as once.
/// @throws Failure kWrongUsage.
void PutIntoAddresses(const RosArguments& ros, Options& options);

/// @throws Failure kWrongUsage naming a topic of which no address has any use.
void CheckTopicsAreUsed(const RosArguments& ros, const Options& options);

/// The node as the addresses have it, or as ROS says if there are none.
[[nodiscard]] DdsNodeAddress NodeOf(const RosArguments& ros, const Options& options);

}  // namespace disflow::apps
