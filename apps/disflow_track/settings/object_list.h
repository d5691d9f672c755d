// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "settings/object_options.h"
#include "settings/settings.h"

namespace disflow::apps {

/// What is said of all objects together.
struct CommonObjectOptions {
  std::uint8_t first_index = 0;
  ObjectFiles files;  ///< With several objects their names are put into these.
};

/// One --object of the command line as the settings file would say it.
/// @param text "name=box,label=1,seed=320:180".
/// @throws Failure kWrongUsage.
[[nodiscard]] ObjectTable ParseObject(const std::string& text, const Config& config);

/// @param tables Empty: one object, which has all settings of `config`.
/// @throws Failure kWrongUsage if the objects cannot be told apart or are too many.
[[nodiscard]] std::vector<ObjectOptions> MakeObjects(const std::vector<ObjectTable>& tables,
                                                     const CommonObjectOptions& common,
                                                     const Config& config);

}  // namespace disflow::apps
