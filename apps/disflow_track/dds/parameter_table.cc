// SPDX-License-Identifier: BSD-3-Clause
#include "dds/parameter_table.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "disflow/config_fields.h"
#include "disflow/posix/dds/ros_names.h"
#include "settings/refusal.h"

namespace disflow::apps {
namespace {

namespace ros = posix::ros;

std::vector<double> ValuesOf(const Config& config) {
  std::vector<double> values;
  VisitFields(config,
              [&values](const auto& field) { values.push_back(static_cast<double>(field.value)); });
  return values;
}

std::string RangeOf(const RosParameter& parameter) {
  return (parameter.is_whole ? "a whole number from " : "a number from ") +
         NumberText(parameter.min) + " to " + NumberText(parameter.max);
}

/// `ros2 param set` sends 1 as an integer, for a double too.
std::optional<double> NumberOf(const ros::ParameterValue& value) noexcept {
  if (value.type == kParameterInteger) return static_cast<double>(value.integer_value);
  if (value.type == kParameterDouble) return value.double_value;
  return std::nullopt;
}

/// @return Why not; empty: it may.
std::string RefusalOf(const RosParameter& parameter, const ros::ParameterValue& value) {
  if (parameter.is_read_only) return parameter.name + " may not change while the program runs";
  const std::optional<double> number = NumberOf(value);
  // Written so that NaN is refused too.
  if (!number || !(*number >= parameter.min && *number <= parameter.max) ||
      (parameter.is_whole && std::trunc(*number) != *number)) {
    return parameter.name + " wants " + RangeOf(parameter);
  }
  return "";
}

void Assign(std::size_t number, double value, Config& config) {
  std::size_t place = 0;
  VisitFields(config, [&](const auto& field) {
    if (place++ != number) return;
    field.value = static_cast<std::remove_reference_t<decltype(field.value)>>(value);
  });
}

}  // namespace

ParameterTable::ParameterTable(std::span<ObjectChannel* const> channels) {
  for (ObjectChannel* const channel : channels) {
    const std::string prefix = posix::RosNamePart(channel->name()) + ".";
    const Config config = channel->settings().Now();
    std::size_t number = 0;
    VisitFields(config, [&](const auto& field) {
      using Value = std::remove_cvref_t<decltype(field.value)>;
      parameters_.push_back({prefix + field.name, objects_.size(), number++,
                             std::is_integral_v<Value>, !field.at_run_time, field.min, field.max,
                             std::string(field.meaning) + " (" + field.unit + ")"});
    });
    objects_.push_back({channel, channel->settings().version(), ValuesOf(config)});
  }
}

const RosParameter* ParameterTable::Find(std::string_view name) const noexcept {
  const auto found =
      std::find_if(parameters_.begin(), parameters_.end(),
                   [name](const RosParameter& parameter) { return parameter.name == name; });
  return found == parameters_.end() ? nullptr : &*found;
}

ros::ParameterValue ParameterTable::ValueOf(const RosParameter& parameter) const {
  static const std::string none;
  ros::ParameterValue value{};
  value.string_value = posix::Lend(none);
  const double number =
      ValuesOf(objects_[parameter.object].channel->settings().Now())[parameter.number];
  if (parameter.is_whole) {
    value.type = kParameterInteger;
    value.integer_value = static_cast<std::int64_t>(number);
  } else {
    value.type = kParameterDouble;
    value.double_value = number;
  }
  return value;
}

std::string ParameterTable::Set(std::span<const WantedParameter> wanted) {
  std::vector<Config> configs;
  for (const Object& object : objects_) configs.push_back(object.channel->settings().Now());
  std::vector<bool> touched(objects_.size());
  for (const WantedParameter& one : wanted) {
    const RosParameter* const parameter = Find(one.name);
    if (parameter == nullptr) return "there is no parameter " + std::string(one.name);
    std::string refusal = RefusalOf(*parameter, one.value);
    if (!refusal.empty()) return refusal;
    Assign(parameter->number, *NumberOf(one.value), configs[parameter->object]);
    touched[parameter->object] = true;
  }
  for (const Config& config : configs) {
    const ConfigIssue issue = Validate(config);
    if (issue.field != nullptr)
      return std::string(issue.field) + " does not fit the other parameters";
  }
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (!touched[i]) continue;
    (void)objects_[i].channel->settings().Change([&configs, i](Config& now) { now = configs[i]; });
  }
  return "";
}

std::vector<const RosParameter*> ParameterTable::TakeChanges() {
  std::vector<const RosParameter*> changed;
  std::size_t first = 0;  // of the object's
  for (Object& object : objects_) {
    const std::uint32_t version = object.channel->settings().version();
    const std::size_t count = object.values.size();
    if (std::exchange(object.version, version) != version) {
      std::vector<double> values = ValuesOf(object.channel->settings().Now());
      for (std::size_t i = 0; i < count; ++i)
        if (values[i] != object.values[i]) changed.push_back(&parameters_[first + i]);
      object.values = std::move(values);
    }
    first += count;
  }
  return changed;
}

std::vector<const RosParameter*> ParameterTable::List(std::string_view prefix,
                                                      std::uint64_t depth) const {
  std::vector<const RosParameter*> list;
  for (const RosParameter& parameter : parameters_) {
    std::string_view rest = parameter.name;
    if (!prefix.empty()) {
      if (!rest.starts_with(prefix)) continue;
      rest.remove_prefix(prefix.size());
      if (!rest.empty() && rest.front() != '.') continue;
      if (!rest.empty()) rest.remove_prefix(1);
    }
    const auto dots = static_cast<std::uint64_t>(std::count(rest.begin(), rest.end(), '.'));
    if (depth == 0 || dots < depth) list.push_back(&parameter);
  }
  return list;
}

}  // namespace disflow::apps
