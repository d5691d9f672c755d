// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "settings/refusal.h"
#include "settings/setting_value.h"
#include "settings/settings.h"
#include "settings/toml_file.h"

namespace disflow::apps {
namespace {

void AssignNode(const std::string& file, const std::string& name, const toml::node& node,
                Config& config) {
  const std::string where = Where(file, node);
  std::ostringstream text;
  if (const auto* integer = node.as_integer()) {
    text << integer->get();
    AssignSetting(where, name, {static_cast<double>(integer->get()), true, text.str()}, config);
  } else if (const auto* floating = node.as_floating_point()) {
    text << *floating;  // with the point that makes it none: 8.0
    AssignSetting(where, name, {floating->get(), false, text.str()}, config);
  } else {
    text << node.type();
    const char* const article = node.is_array() ? " is an " : " is a ";
    Refuse(where, name + article + text.str() + ", a number is needed");
  }
}

/// @return false if the node is no text, number or truth value.
bool AppendValue(const toml::node& node, std::vector<std::string>& values) {
  if (const auto* text = node.as_string()) {
    values.push_back(text->get());
  } else if (const auto* truth = node.as_boolean()) {
    values.emplace_back(truth->get() ? "true" : "false");
  } else if (const auto* integer = node.as_integer()) {
    values.push_back(std::to_string(integer->get()));
  } else if (const auto* floating = node.as_floating_point()) {
    values.push_back(NumberText(floating->get()));
  } else {
    return false;
  }
  return true;
}

RunSetting ReadRunSetting(const std::string& file, std::string_view key, const toml::node& node) {
  RunSetting setting{.where = Where(file, node), .option = std::string(key), .values = {}};
  bool usable = true;
  if (const toml::array* const array = node.as_array()) {
    for (const toml::node& element : *array)
      usable = usable && AppendValue(element, setting.values);
  } else {
    usable = AppendValue(node, setting.values);
  }
  if (!usable) {
    Refuse(setting.where,
           std::string(key) + ": a text, a number, true, false or a list of these is needed");
  }
  return setting;
}

/// "mesh_picture" of the section [run] is --mesh-picture.
RunSetting ReadOption(const std::string& file, std::string_view key, const toml::node& node) {
  RunSetting setting = ReadRunSetting(file, key, node);
  std::replace(setting.option.begin(), setting.option.end(), '_', '-');
  setting.option.insert(0, "--");
  return setting;
}

void AssignSection(const std::string& file, std::string_view section, const toml::table& table,
                   Config& config) {
  for (const auto& [key, value] : table) {
    AssignNode(file, std::string(section) + "." + std::string(key.str()), value, config);
  }
}

std::vector<ObjectTable> ReadObjects(const std::string& file, const toml::node& node,
                                     const Config& config) {
  const toml::array* const array = node.as_array();
  if (array == nullptr || !(array->empty() || array->is_homogeneous<toml::table>()))
    Refuse(Where(file, node), "objects are tables, each headed [[object]]");
  std::vector<ObjectTable> objects;
  for (const toml::node& element : *array) {
    ObjectTable& object = objects.emplace_back();
    object.where = Where(file, element);
    object.config = config;
    for (const auto& [key, value] : *element.as_table()) {
      if (const toml::table* const section = value.as_table()) {
        AssignSection(file, key.str(), *section, object.config);
      } else {
        object.keys.push_back(ReadRunSetting(file, key.str(), value));
      }
    }
  }
  return objects;
}

}  // namespace

SettingsFile LoadSettings(const std::string& file, Config& config) {
  SettingsFile settings;
  const toml::table root = ParseTomlFile(file);
  for (const auto& [section, node] : root) {
    if (section == "object") continue;
    const toml::table* const table = node.as_table();
    if (node.is_array_of_tables()) {
      const std::string name(section.str());
      Refuse(Where(file, node),
             std::string("[[").append(name) + "]] is a list of sections; write [" + name + "]");
    } else if (table == nullptr) {
      AssignNode(file, std::string(section.str()), node, config);
    } else if (section == "run") {
      for (const auto& [key, value] : *table)
        settings.run.push_back(ReadOption(file, key.str(), value));
    } else {
      AssignSection(file, section.str(), *table, config);
    }
  }
  // Last, since each starts from what the file says of all.
  if (const toml::node* const objects = root.get("object"))
    settings.objects = ReadObjects(file, *objects, config);
  return settings;
}

void ApplySetting(std::string_view assignment, Config& config) {
  const std::string where = "--set " + std::string(assignment) + ": ";
  const std::size_t equals = assignment.find('=');
  if (equals == 0 || equals == std::string_view::npos) {
    Refuse(where, "name=value is needed, e.g. registration.iterations=10");
  }
  const std::string_view text = assignment.substr(equals + 1);
  const char* const end = text.data() + text.size();
  SettingNumber number{.text = std::string(text)};
  const auto [stop, error] = std::from_chars(text.data(), end, number.value);
  if (error != std::errc{} || stop != end) Refuse(where, "'" + number.text + "' is not a number");
  number.is_integer = std::trunc(number.value) == number.value;
  AssignSetting(where, assignment.substr(0, equals), number, config);
}

void CheckSettings(const Config& config) {
  const ConfigIssue issue = Validate(config);
  if (issue.status() == Status::kOk) return;
  Refuse("", std::string(issue.field) + " = " + NumberText(issue.value) +
                 " does not fit the other settings; allowed: " + NumberText(issue.min) + " to " +
                 NumberText(issue.max));
}

}  // namespace disflow::apps
