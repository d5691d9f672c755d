// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "disflow/config.h"
#include "settings/settings_file.h"

namespace disflow::apps {

/// Reads files of parameters as ROS 2 has them (`--params-file`, `ros2 param dump`): for a node or
/// for all, `/**`, what stands under ros__parameters. SECTION.SETTING is one of all objects,
/// OBJECT.SECTION.SETTING one of an object, run.OPTION an option of the command line.
/// @param files What a later one says counts. At least one says something of the node.
/// @param node_name With its namespace: "/robot1/disflow". Nodes of other names are passed over.
/// @param config Gets the settings of all objects.
/// @return What else they say.
/// @throws Failure kWrongUsage naming file, line, parameter and what is wrong with it.
[[nodiscard]] SettingsFile LoadRosParameters(std::span<const std::string> files,
                                             const std::string& node_name, Config& config);

/// The same of one parameter.
/// @param assignment NAME:=VALUE, the value as in such a file.
/// @throws Failure kWrongUsage.
void ReadRosParameter(const std::string& assignment, SettingsFile& settings, Config& config);

}  // namespace disflow::apps
