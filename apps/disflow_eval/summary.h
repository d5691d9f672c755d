// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plots.h"
#include "report.h"

namespace disflow::apps {

/// One page of Markdown: all numbers, and the plots as pictures.
/// @param summary_dir Folder in which the page will lie; links are relative to it.
/// @param plots_dir Folder of the plots.
[[nodiscard]] std::string FormatSummary(const Report& report, const std::vector<Plot>& plots,
                                        const std::filesystem::path& summary_dir,
                                        const std::filesystem::path& plots_dir);

}  // namespace disflow::apps
