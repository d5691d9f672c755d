// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace disflow::apps {

/// A file that somebody wrote settings into.
/// @throws Failure kWrongUsage if it cannot be read or is far longer than settings are.
[[nodiscard]] std::string ReadSettingsText(const std::string& file);

}  // namespace disflow::apps
