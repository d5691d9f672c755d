// SPDX-License-Identifier: BSD-3-Clause
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <type_traits>

#include "disflow/config_fields.h"
#include "program/exit_status.h"
#include "settings/settings.h"

namespace disflow::apps {
namespace {

struct Number {
  double value = 0.0;
  bool is_integer = false;
  std::string text;  ///< As the person wrote it.
};

std::string Compact(double value) {
  char text[32];
  (void)std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

/// @param where Ahead of every message, e.g. "run.toml:12: ".
void Assign(const std::string& where, std::string_view name, const Number& number, Config& config) {
  bool found = false;
  VisitFields(config, [&](const auto& field) {
    if (name != field.name) return;
    found = true;
    using Value = std::remove_reference_t<decltype(field.value)>;
    const std::string range =
        "allowed: " + Compact(field.min) + " to " + Compact(field.max) + " " + field.unit;
    if (std::is_integral_v<Value> && !number.is_integer) {
      Refuse(where, std::string(name) + " = " + number.text + " is not a whole number; " + range);
    }
    // Written so that NaN is refused too.
    if (!(number.value >= field.min && number.value <= field.max)) {
      Refuse(where, std::string(name) + " = " + number.text + " is out of range; " + range);
    }
    field.value = static_cast<Value>(number.value);
  });
  if (!found) {
    Refuse(where,
           "there is no setting " + std::string(name) + "; disflow_track --print-config lists all");
  }
}

std::string Where(const std::string& file, const toml::node& node) {
  return file + ":" + std::to_string(node.source().begin.line) + ": ";
}

void AssignNode(const std::string& file, const std::string& name, const toml::node& node,
                Config& config) {
  const std::string where = Where(file, node);
  std::ostringstream text;
  if (const auto* integer = node.as_integer()) {
    text << integer->get();
    Assign(where, name, {static_cast<double>(integer->get()), true, text.str()}, config);
  } else if (const auto* floating = node.as_floating_point()) {
    text << floating->get();
    Assign(where, name, {floating->get(), false, text.str()}, config);
  } else {
    text << node.type();
    Refuse(where, name + " is a " + text.str() + ", a number is needed");
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
    values.push_back(Compact(floating->get()));
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
  toml::table root;
  try {
    root = toml::parse_file(file);
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    const std::string at = line > 0 ? ":" + std::to_string(line) : "";
    Refuse(file + at + ": ", std::string(error.description()));
  }
  for (const auto& [section, node] : root) {
    if (section == "object") continue;
    const toml::table* const table = node.as_table();
    if (table == nullptr) {
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
  Number number{.text = std::string(text)};
  const auto [stop, error] = std::from_chars(text.data(), end, number.value);
  if (error != std::errc{} || stop != end) Refuse(where, "'" + number.text + "' is not a number");
  number.is_integer = std::trunc(number.value) == number.value;
  Assign(where, assignment.substr(0, equals), number, config);
}

void CheckSettings(const Config& config) {
  const ConfigIssue issue = Validate(config);
  if (issue.status() == Status::kOk) return;
  Refuse("", std::string(issue.field) + " = " + Compact(issue.value) +
                 " does not fit the other settings; allowed: " + Compact(issue.min) + " to " +
                 Compact(issue.max));
}

}  // namespace disflow::apps
