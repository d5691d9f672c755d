// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "settings/options.h"

namespace disflow::apps {

/// What to do about a folder that has something in it.
inline constexpr const char* kOtherFolder =
    "give another folder, clear this one, or put {n} into its name for a new one at each start";

/// Gives every output whose name has kRunNumber in it a name that nothing has yet: all of them the
/// same number, one more than the highest that any of them finds. A number and no time, since many
/// boards do not know the time when they start.
/// @throws Failure kWrongUsage, kOutputFailed if a folder cannot be read.
[[nodiscard]] Options NumberOutputs(Options options);

/// Removes trajectories and recordings whose names fit and whose numbers are not among the highest.
/// Of a recording's folder what belongs to the recording, and the folder if nothing else is in it.
/// @param options Before NumberOutputs().
/// @param keep How many numbers are left, at least 1.
/// @throws Failure kOutputFailed naming what cannot be removed.
void RemoveOldOutputs(const Options& options, int keep);

}  // namespace disflow::apps
