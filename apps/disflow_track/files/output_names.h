// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "settings/options.h"

namespace disflow::apps {

/// Makes sure that no two outputs of a run, of whatever kind and object, are one file or folder,
/// and that none is an input of the run, see FindClash(): each would destroy the other.
/// @throws Failure kWrongUsage naming both options.
void RefuseSharedOutputs(const Options& options);

}  // namespace disflow::apps
