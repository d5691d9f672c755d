// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "disflow/config.h"
#include "settings/settings_file.h"

/// @file
/// The tracker's settings as people write and read them. Names, units, ranges and meanings come
/// from VisitFields().

namespace disflow::apps {

/// Overwrites the settings that a TOML file mentions.
/// @return What else it says.
/// @throws Failure kWrongUsage naming file, line, key, value and allowed range.
[[nodiscard]] SettingsFile LoadSettings(const std::string& file, Config& config);

/// Overwrites one setting.
/// @param assignment "registration.iterations=10".
/// @throws Failure kWrongUsage naming key, value and allowed range.
void ApplySetting(std::string_view assignment, Config& config);

/// Checks what concerns several settings at once.
/// @throws Failure kWrongUsage.
void CheckSettings(const Config& config);

/// @return A complete settings file with comments; LoadSettings() reads exactly the same settings
/// from it.
[[nodiscard]] std::string FormatSettings(const Config& config);

/// @return docs/settings.md: a page with all settings and their defaults.
[[nodiscard]] std::string FormatSettingsPage();

}  // namespace disflow::apps
