// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "report.h"

/// @file
/// Several trajectories of one sequence beside each other.

namespace disflow::apps {

/// A table for a terminal: a column for each run, the best of each row marked.
/// @param reports Not empty.
[[nodiscard]] std::string FormatComparison(const std::vector<const Report*>& reports);

/// A table for LaTeX in the form of the paper's tables I to III, the best of each column bold;
/// needs booktabs. What nobody measured has no column.
/// @param reports Not empty.
[[nodiscard]] std::string FormatLatex(const std::vector<const Report*>& reports);

}  // namespace disflow::apps
