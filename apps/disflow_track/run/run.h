// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "program/exit_status.h"
#include "settings/options.h"
#include "settings/settings_reread.h"

namespace disflow::apps {

/// Tracks from the first frame to the last and writes everything that was asked for.
/// @return kDone, or what failed although the run came to its end.
/// @param command What the options were read from, for when they are read again.
/// @throws Failure for what kept the run from starting or broke it off.
[[nodiscard]] ExitStatus Run(const Options& options, const CommandLine& command);

}  // namespace disflow::apps
