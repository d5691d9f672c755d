// SPDX-License-Identifier: BSD-3-Clause
#include "objects/running_settings.h"

#include <cmath>
#include <type_traits>

#include "disflow/config_fields.h"

namespace disflow::apps {
namespace {

/// @return false if the setting cannot have this value.
template <class Field>
bool Assign(const Field& field, double value) {
  using Value = std::remove_reference_t<decltype(field.value)>;
  // Written so that NaN is refused too.
  if (!(value >= field.min && value <= field.max)) return false;
  if (std::is_integral_v<Value> && std::trunc(value) != value) return false;
  field.value = static_cast<Value>(value);
  return true;
}

}  // namespace

Config RunningSettings::Now() const {
  const std::lock_guard lock(mutex_);
  return now_;
}

bool RunningSettings::Set(std::size_t number, double value) {
  bool is_set = false;
  const ConfigIssue issue = Change([&](Config& config) {
    std::size_t place = 0;
    VisitFields(config, [&](const auto& field) {
      if (place++ == number && field.at_run_time) is_set = Assign(field, value);
    });
  });
  return is_set && issue.field == nullptr;
}

ConfigIssue RunningSettings::Adopt(const Config& wanted) {
  const Config adjusted = AdjustedAtRunTime(now_, wanted);
  const ConfigIssue issue = Validate(adjusted);
  if (issue.field != nullptr) return issue;
  now_ = adjusted;
  is_new_ = true;
  ++version_;
  return issue;
}

bool RunningSettings::Take(Config& config) noexcept {
  if (!is_new_) return false;
  // Whoever holds it is about to change something more, for the next frame.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return false;
  is_new_ = false;
  config = now_;
  return true;
}

}  // namespace disflow::apps
