// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <type_traits>

#include "disflow/config_fields.h"

namespace disflow {

/// Gives setting number `index` a value made by `change(current value, min, max)`.
/// @return The setting's name, empty beyond the last.
template <class Change>
std::string ChangeField(Config& config, int index, Change&& change) {
  std::string name;
  int i = 0;
  VisitFields(config, [&](auto field) {
    if (i++ != index) return;
    name = field.name;
    using Value = std::remove_reference_t<decltype(field.value)>;
    field.value = change(Value{}, static_cast<Value>(field.min), static_cast<Value>(field.max));
  });
  return name;
}

inline int FieldCount() {
  Config config;
  int count = 0;
  VisitFields(config, [&count](auto) { ++count; });
  return count;
}

inline constexpr auto kMinimum = [](auto, auto min, auto) { return min; };
inline constexpr auto kMaximum = [](auto, auto, auto max) { return max; };

}  // namespace disflow
