// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "disflow/config.h"

namespace disflow::apps {

/// What somebody wrote for one of the tracker's settings.
struct SettingNumber {
  double value = 0.0;
  bool is_integer = false;
  std::string text;  ///< As the person wrote it.
};

/// Overwrites one setting.
/// @param where Ahead of every message, e.g. "run.toml:12: ".
/// @param name "registration.iterations".
/// @throws Failure kWrongUsage naming setting, value and allowed range.
void AssignSetting(const std::string& where, std::string_view name, const SettingNumber& number,
                   Config& config);

}  // namespace disflow::apps
