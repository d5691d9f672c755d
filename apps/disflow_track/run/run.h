// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "program/exit_status.h"
#include "settings/options.h"

namespace disflow::apps {

/// Tracks from the first frame to the last and writes everything that was asked for.
/// @return kDone, or what failed although the run came to its end.
/// @throws Failure for what kept the run from starting or broke it off.
[[nodiscard]] ExitStatus Run(const Options& options);

}  // namespace disflow::apps
