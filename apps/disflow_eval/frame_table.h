// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report.h"

namespace disflow::apps {

/// The errors of every frame as CSV, for plots and for other programs. SI units and degrees.
/// Columns are named in the first line; what is not known is "nan".
[[nodiscard]] std::string FormatFrames(const Report& report);

}  // namespace disflow::apps
