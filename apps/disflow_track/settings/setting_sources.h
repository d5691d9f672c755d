// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "settings/object_list.h"
#include "settings/options.h"
#include "settings/ros_arguments.h"

namespace disflow::apps {

/// What was typed about settings and objects, and the file that says more.
struct SettingSources {
  std::string file;
  std::vector<std::string> parameter_files;  ///< Of ROS, in place of the other.
  RosArguments ros;
  std::vector<std::string> assignments;
  // Short forms of settings.
  std::vector<int> roi_px;
  std::vector<float> range_m;
  std::vector<int> seed_px;
  std::vector<std::string> objects;
  CommonObjectOptions common;
};

/// The file, then the parameters that ROS handed over, then the short forms, then --set; then the
/// objects, which start from these.
/// @param app Has parsed the command line. Options that the file's section [run] gives are set by
/// it, unless they were typed.
/// @throws Failure kWrongUsage.
void ReadSettings(CLI::App& app, SettingSources& settings, Options& options);

}  // namespace disflow::apps
