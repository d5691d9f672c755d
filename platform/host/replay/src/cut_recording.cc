// SPDX-License-Identifier: BSD-3-Clause
#include "cut_recording.h"

#include <algorithm>
#include <optional>
#include <string>

#include "disflow/host/recorded_stamp.h"
#include "float_depth_file.h"

namespace disflow::host {

namespace fs = std::filesystem;

void LeaveOut(const std::string& reason, SequenceIndex& index) {
  ++index.cut_frames;
  index.cut_note += (index.cut_note.empty() ? "" : "; ") + reason;
}

bool EndsWithinItsLastLine(const TextTable& stamps) {
  const std::vector<TableRow>& rows = stamps.rows();
  if (rows.empty() || stamps.ends_with_line_feed()) return false;
  if (rows.back().fields.size() < 2) return true;
  const TableRow* const before = rows.size() > 1 ? &rows[rows.size() - 2] : nullptr;
  const std::string_view stamp_before =
      before != nullptr && before->fields.size() > 1 ? before->fields[1] : "";
  return IsCutStamp(rows.back().fields[1],
                    before != nullptr ? std::optional(stamp_before) : std::nullopt);
}

hal::Fault LeaveOutUnlisted(const fs::path& stamps, const std::vector<NumberedFile>& unlisted,
                            SequenceIndex& index) {
  if (unlisted.empty()) return {};
  const NumberedFile& first = unlisted.front();
  const bool is_last =
      std::all_of(index.frames.begin(), index.frames.end(),
                  [&first](const RecordedFrame& frame) { return frame.number < first.number; });
  if (unlisted.size() > 1 || !is_last) {
    return hal::MakeFault(Status::kCorrupt,
                          "%s: has no line for %s and %zu more; a recording that was cut short "
                          "lacks one. Remove the images, or this file and say fps=30",
                          stamps.c_str(), first.path.filename().c_str(), unlisted.size() - 1);
  }
  if (index.frames.empty()) {
    return hal::MakeFault(Status::kTruncated,
                          "%s: has no line; the recording was cut short before its first frame was "
                          "complete",
                          stamps.c_str());
  }
  LeaveOut(first.path.string() + " has no line in " + stamps.filename().string(), index);
  return {};
}

void LeaveOutCutDepth(SequenceIndex& index) {
  if (index.frames.size() < 2) return;
  FloatImage image;
  const hal::Fault fault = ReadFloatDepth(index.frames.back().depth, image);
  if (fault.status != Status::kTruncated) return;
  index.frames.pop_back();
  LeaveOut(fault.message, index);
}

}  // namespace disflow::host
