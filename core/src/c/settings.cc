// SPDX-License-Identifier: BSD-3-Clause
#include "settings.h"

#include <cmath>
#include <cstring>
#include <type_traits>

#include "disflow/config_fields.h"

namespace disflow::c {
namespace {

/// @param field Of settings that all have their defaults.
template <class Field>
disflow_setting_info InfoOf(const Field& field) noexcept {
  return {field.name,
          field.unit,
          field.meaning,
          static_cast<float>(field.value),
          static_cast<float>(field.min),
          static_cast<float>(field.max),
          std::is_integral_v<std::remove_cvref_t<decltype(field.value)>> ? 1 : 0};
}

disflow_setting_info InfoOf(const char* name) noexcept {
  const Config defaults;
  disflow_setting_info info{};
  VisitFields(defaults, [&](const auto& field) {
    if (std::strcmp(field.name, name) == 0) info = InfoOf(field);
  });
  return info;
}

/// Ranges are checked later, all at once.
Status Assign(const disflow_setting& setting, Config& config) noexcept {
  Status status = Status::kNotFound;
  VisitFields(config, [&](const auto& field) {
    if (std::strcmp(field.name, setting.name) != 0) return;
    using Value = std::remove_cvref_t<decltype(field.value)>;
    constexpr float kLargestWhole = 16777216.0F;  // from there on float does not hold them all
    const bool fits = !std::is_integral_v<Value> || (std::abs(setting.value) < kLargestWhole &&
                                                     std::trunc(setting.value) == setting.value);
    status = fits ? Status::kOk : Status::kInvalidConfig;
    if (fits) field.value = static_cast<Value>(setting.value);
  });
  return status;
}

}  // namespace

Status Apply(const disflow_setting* settings, std::size_t count, Config& config,
             disflow_setting_info* refused) noexcept {
  if (settings == nullptr && count != 0) return Status::kNotInitialised;
  const auto refuse = [&](Status status, const char* name) {
    if (refused != nullptr) *refused = InfoOf(name);
    if (refused != nullptr && status == Status::kNotFound) refused->name = name;
    return status;
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (settings[i].name == nullptr) return Status::kNotFound;
    const Status status = Assign(settings[i], config);
    if (status != Status::kOk) return refuse(status, settings[i].name);
  }
  const ConfigIssue issue = Validate(config);
  if (issue.field == nullptr) return Status::kOk;
  const Status status = refuse(issue.status(), issue.field);
  if (refused != nullptr) {
    // Beside the other settings less may be allowed.
    refused->min = static_cast<float>(issue.min);
    refused->max = static_cast<float>(issue.max);
  }
  return status;
}

}  // namespace disflow::c

std::int32_t disflow_setting_count(void) {
  const disflow::Config defaults;
  std::int32_t count = 0;
  disflow::VisitFields(defaults, [&count](const auto&) { ++count; });
  return count;
}

disflow_status disflow_describe_setting(std::int32_t index, disflow_setting_info* info) {
  if (info == nullptr) return DISFLOW_NOT_INITIALISED;
  *info = {};
  const disflow::Config defaults;
  std::int32_t i = 0;
  disflow::VisitFields(defaults, [&](const auto& field) {
    if (i++ == index) *info = disflow::c::InfoOf(field);
  });
  return info->name != nullptr ? DISFLOW_OK : DISFLOW_OUT_OF_BOUNDS;
}
