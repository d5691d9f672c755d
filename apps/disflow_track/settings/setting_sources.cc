// SPDX-License-Identifier: BSD-3-Clause
#include "settings/setting_sources.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "program/exit_status.h"
#include "settings/ros_parameter_file.h"
#include "settings/settings.h"

namespace disflow::apps {
namespace {

bool MayStandInAFile(const std::string& option) {
  constexpr std::array kOnlyTyped = {
      "--config",  "--params-file",  "--ros-args",     "--help",
      "--version", "--list-sensors", "--print-config", "--print-settings-table"};
  return std::find(kOnlyTyped.begin(), kOnlyTyped.end(), option) == kOnlyTyped.end();
}

/// Gives an option of a settings file to the command line's parser, unless it was typed.
void ApplyRunSetting(CLI::App& app, const RunSetting& setting) {
  CLI::Option* const option =
      MayStandInAFile(setting.option) ? app.get_option_no_throw(setting.option) : nullptr;
  if (option == nullptr) {
    throw Failure(kWrongUsage, setting.where + "there is no option " + setting.option +
                                   " that could stand in [run]; see disflow_track --help");
  }
  if (option->count() > 0) return;
  // A flag that is off is one that was not given.
  const bool is_flag = option->get_expected_max() == 0;
  if (is_flag && setting.values == std::vector<std::string>{"false"}) return;
  try {
    for (const std::string& value : setting.values) option->add_result(value);
    option->run_callback();
  } catch (const CLI::Error& error) {
    throw Failure(kWrongUsage, setting.where + error.what());
  }
}

void ApplyShortForms(const SettingSources& settings, Config& config) {
  const auto apply = [&config](const char* name, const auto& value) {
    ApplySetting(std::string("segmenter.") + name + "=" + std::to_string(value), config);
  };
  if (!settings.roi_px.empty()) {
    apply("roi_x_px", settings.roi_px[0]);
    apply("roi_y_px", settings.roi_px[1]);
    apply("roi_width_px", settings.roi_px[2]);
    apply("roi_height_px", settings.roi_px[3]);
  }
  if (!settings.range_m.empty()) {
    apply("min_range_m", settings.range_m[0]);
    apply("max_range_m", settings.range_m[1]);
  }
  if (!settings.seed_px.empty()) {
    apply("seed_u_px", settings.seed_px[0]);
    apply("seed_v_px", settings.seed_px[1]);
  }
}

/// What was typed wins over what the file says.
void ApplyTyped(const SettingSources& settings, Config& config) {
  ApplyShortForms(settings, config);
  for (const std::string& assignment : settings.assignments) ApplySetting(assignment, config);
}

/// What the file says of single objects, now that they are known.
void ApplyNamed(const SettingSources& settings, const std::vector<NamedSetting>& named,
                std::vector<ObjectOptions>& objects) {
  for (const NamedSetting& setting : named) {
    const auto object = std::find_if(
        objects.begin(), objects.end(),
        [&setting](const ObjectOptions& candidate) { return candidate.name == setting.object; });
    if (object == objects.end()) {
      throw Failure(kWrongUsage, setting.where + "there is no object " + setting.object + " for " +
                                     setting.name);
    }
    AssignSetting(setting.where, setting.name, setting.number, object->config);
  }
  if (named.empty()) return;
  for (ObjectOptions& object : objects) {
    ApplyTyped(settings, object.config);
    CheckSettings(object.config);
  }
}

}  // namespace

void ReadSettings(CLI::App& app, SettingSources& settings, Options& options) {
  SettingsFile file;
  PutIntoAddresses(settings.ros, options);
  const bool of_ros = !settings.parameter_files.empty();
  if (of_ros && !settings.file.empty())
    throw Failure(kWrongUsage, "settings come from --config or from --params-file, not both");
  if (of_ros || !settings.file.empty()) {
    // The node as it was typed: what a file says comes too late for that.
    file = of_ros ? LoadRosParameters(settings.parameter_files,
                                      NodeOf(settings.ros, options).FullName(), options.config)
                  : LoadSettings(settings.file, options.config);
    options.settings_files =
        of_ros ? settings.parameter_files : std::vector<std::string>{settings.file};
  }
  for (const std::string& parameter : settings.ros.parameters)
    ReadRosParameter(parameter, file, options.config);
  for (const RunSetting& setting : file.run) ApplyRunSetting(app, setting);
  options.file = file;
  PutIntoAddresses(settings.ros, options);  // those of the file as well
  ApplyTyped(settings, options.config);
  CheckSettings(options.config);
  for (ObjectTable& object : file.objects) ApplyTyped(settings, object.config);
  if (!settings.objects.empty()) file.objects.clear();
  for (const std::string& object : settings.objects)
    file.objects.push_back(ParseObject(object, options.config));
  if (file.objects.size() > 1 && !settings.seed_px.empty()) {
    throw Failure(kWrongUsage,
                  "--seed names one object; with several, give each its own, e.g. --object "
                  "name=box,seed=320:180");
  }
  options.objects = MakeObjects(file.objects, settings.common, options.config);
  ApplyNamed(settings, file.named, options.objects);
}

}  // namespace disflow::apps
