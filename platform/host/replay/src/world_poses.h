// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sequence_index.h"

namespace disflow::host {

/// Reads T_wc.txt or pose/*.txt into the frames, as the options say. Every frame needs one.
[[nodiscard]] hal::Fault ReadWorldPoses(const ReplayOptions& options, SequenceIndex& index);

}  // namespace disflow::host
