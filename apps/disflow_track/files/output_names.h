// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "settings/options.h"

namespace disflow::apps {

/// Makes sure that no two outputs of a run, of whatever kind and object, are one file or folder:
/// each would destroy the other. Sees through other spellings (./a and a), symbolic and hard links;
/// the files need not exist. What cannot be destroyed (/dev/null, a terminal) may be named several
/// times.
/// @throws Failure kWrongUsage naming both options.
void RefuseSharedOutputs(const Options& options);

}  // namespace disflow::apps
