// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "disflow/hal/fault.h"
#include "disflow/host/numbered_files.h"
#include "sequence_index.h"
#include "text_table.h"

namespace disflow::host {

/// @file
/// What a recording lacks whose program was killed, or whose machine lost its power: the end of its
/// last frame. SequenceWriter says in which order files are written.

/// Whether the last line of data.txt was not written to its end.
[[nodiscard]] bool EndsWithinItsLastLine(const TextTable& stamps);

/// Counts and notes one frame that is not among the index's.
void LeaveOut(const std::string& reason, SequenceIndex& index);

/// Leaves out the image that was being written when the recording ended: it has no line in
/// data.txt.
/// @param unlisted All images without a line, by number.
/// @return kCorrupt if there are more of them or they are not behind all others, kTruncated if no
/// frame is left.
[[nodiscard]] hal::Fault LeaveOutUnlisted(const std::filesystem::path& stamps,
                                          const std::vector<NumberedFile>& unlisted,
                                          SequenceIndex& index);

/// Leaves out the last frame if its depth file is cut: the kernel had not written it yet.
void LeaveOutCutDepth(SequenceIndex& index);

}  // namespace disflow::host
