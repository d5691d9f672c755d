// SPDX-License-Identifier: BSD-3-Clause
#include "settings/ros_parameter_file.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

#include "disflow/posix/shown_text.h"
#include "settings/refusal.h"
#include "settings/settings_text.h"
#include "settings/yaml_place.h"

namespace disflow::apps {
namespace {

constexpr const char* kParameters = "ros__parameters";

/// Whether a file's section of that name is for the node.
bool IsMeant(const std::string& name, const std::string& node_name) {
  if (name == "/**" || name == "/*") return true;
  const std::string any_namespace = "/**" + node_name.substr(node_name.rfind('/'));
  return name == node_name || "/" + name == node_name || name == any_namespace;
}

class ParameterReader {
 public:
  ParameterReader(const std::string& file, SettingsFile& settings, Config& config)
      : file_(file), settings_(settings), config_(config) {}

  /// What stands in a map, under `name` as far as that goes.
  void ReadMap(const std::string& name, const YAML::Node& map, std::size_t depth) {
    constexpr std::size_t kMostDepth = 8;
    if (depth > kMostDepth) Refuse(At(map), name + " is deeper than parameters are");
    for (const auto& entry : map) {
      if (!entry.first.IsScalar()) Refuse(At(entry.first), "the name of a parameter is no text");
      // Aliases make a short file say very much.
      constexpr int kMostParameters = 10'000;
      if (++count_ > kMostParameters)
        Refuse(At(entry.first), "there are more than 10000 parameters");
      const std::string full =
          name.empty() ? entry.first.Scalar() : name + "." + entry.first.Scalar();
      if (entry.second.IsMap()) {
        ReadMap(full, entry.second, depth + 1);
      } else {
        Read(full, entry.first, entry.second);
      }
    }
  }

 private:
  [[nodiscard]] std::string At(const YAML::Node& node) const {
    return YamlPlace(file_, node.Mark());
  }

  /// @param key Says where it stands: what is empty stands nowhere.
  void Read(const std::string& name, const YAML::Node& key, const YAML::Node& value) {
    constexpr std::string_view kRun = "run.";
    if (name.starts_with(kRun)) return ReadOption(name, name.substr(kRun.size()), key, value);
    // What every node of rclcpp has, and a dump of it: there is no simulated clock here.
    if (name == "use_sim_time" || name.starts_with("qos_overrides.")) return;
    const auto dots = std::count(name.begin(), name.end(), '.');
    if (dots == 1) {
      AssignSetting(At(key), name, NumberOf(name, key, value), config_);
    } else if (dots == 2) {
      const std::size_t dot = name.find('.');
      NamedSetting& setting = settings_.named.emplace_back();
      setting = {At(key), name.substr(0, dot), name.substr(dot + 1), NumberOf(name, key, value)};
      // Whether there is such an object is known when all are.
      Config scratch;
      AssignSetting(setting.where, setting.name, setting.number, scratch);
    } else {
      Refuse(At(key), "there is no parameter " + name +
                          "; known are SECTION.SETTING, OBJECT.SECTION.SETTING (docs/settings.md) "
                          "and run.OPTION");
    }
  }

  [[nodiscard]] SettingNumber NumberOf(const std::string& name, const YAML::Node& key,
                                       const YAML::Node& value) const {
    SettingNumber number;
    // What stands in quotes is a text to ROS as well.
    const bool is_plain = value.IsScalar() && value.Tag() != "!";
    if (!is_plain || !YAML::convert<double>::decode(value, number.value))
      Refuse(At(key), name + " is no number");
    number.text = value.Scalar();
    number.is_integer = std::trunc(number.value) == number.value &&
                        number.text.find_first_of(".eE") == std::string::npos;
    return number;
  }

  void ReadOption(const std::string& name, std::string option, const YAML::Node& key,
                  const YAML::Node& value) {
    std::replace(option.begin(), option.end(), '_', '-');
    RunSetting setting{At(key), "--" + option, {}};
    bool usable = value.IsScalar() || value.IsSequence();
    if (value.IsScalar()) setting.values.push_back(value.Scalar());
    for (const YAML::Node& element : value) {
      usable = usable && element.IsScalar();
      if (usable) setting.values.push_back(element.Scalar());
    }
    if (!usable)
      Refuse(setting.where, name + ": a text, a number, true, false or a list of these is needed");
    // The last word about an option counts, as of a parameter.
    std::erase_if(settings_.run,
                  [&setting](const RunSetting& old) { return old.option == setting.option; });
    settings_.run.push_back(std::move(setting));
  }

  const std::string& file_;
  SettingsFile& settings_;
  Config& config_;
  int count_ = 0;
};

/// YAML of one value stands nowhere in a file.
YAML::Node ValueOf(const std::string& where, const std::string& text) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    Refuse(where + ": ", error.msg);
  }
}

/// @return Whether it says anything of the node.
bool ReadFile(const std::string& file, const std::string& node_name, SettingsFile& settings,
              Config& config) {
  const std::string text = ReadSettingsText(file);
  ParameterReader reader(file, settings, config);
  bool is_meant = false;
  try {
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) Refuse(file + ": ", "holds no node with " + std::string(kParameters));
    for (const auto& node : root) {
      if (!node.first.IsScalar() || !IsMeant(node.first.Scalar(), node_name)) continue;
      is_meant = true;
      const YAML::Node parameters =
          node.second.IsMap() ? node.second[kParameters] : YAML::Node(YAML::NodeType::Undefined);
      if (!parameters.IsDefined() || !(parameters.IsMap() || parameters.IsNull())) {
        Refuse(YamlPlace(file, node.first.Mark()),
               node.first.Scalar() + " holds no " + kParameters + " with names and values");
      }
      reader.ReadMap("", parameters, 0);
    }
  } catch (const YAML::Exception& error) {
    Refuse(YamlPlace(file, error.mark), error.msg);
  }
  return is_meant;
}

}  // namespace

void ReadRosParameter(const std::string& assignment, SettingsFile& settings, Config& config) {
  const std::string where = "-p " + posix::ShownText(assignment);
  const std::size_t assign = assignment.find(":=");
  YAML::Node map;
  map[assignment.substr(0, assign)] = ValueOf(where, assignment.substr(assign + 2));
  ParameterReader(where, settings, config).ReadMap("", map, 0);
}

SettingsFile LoadRosParameters(std::span<const std::string> files, const std::string& node_name,
                               Config& config) {
  SettingsFile settings;
  bool are_meant = false;
  std::string all;
  for (const std::string& file : files) {
    const bool is_meant = ReadFile(file, node_name, settings, config);
    are_meant = are_meant || is_meant;
    all += (all.empty() ? "" : ", ") + file;
  }
  if (!are_meant) {
    Refuse(all + ": ", "nothing is said of the node " + node_name + "; head it with " + node_name +
                           ": or /**:, and " + kParameters + ": below");
  }
  return settings;
}

}  // namespace disflow::apps
