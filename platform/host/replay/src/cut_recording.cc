// SPDX-License-Identifier: BSD-3-Clause
#include "cut_recording.h"

#include <algorithm>
#include <string>

#include "float_depth_file.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

std::size_t Decimals(const TableRow& row) {
  if (row.fields.size() < 2) return 0;
  const std::size_t point = row.fields[1].find('.');
  return point == std::string_view::npos ? 0 : row.fields[1].size() - point - 1;
}

}  // namespace

void LeaveOut(const std::string& reason, SequenceIndex& index) {
  ++index.cut_frames;
  index.cut_note += (index.cut_note.empty() ? "" : "; ") + reason;
}

bool EndsWithinItsLastLine(const TextTable& stamps) {
  const std::vector<TableRow>& rows = stamps.rows();
  if (rows.empty() || stamps.ends_with_line_feed()) return false;
  if (rows.back().fields.size() < 2) return true;
  // Others may leave out the last line feed, but a recording's stamps have nine decimals each: one
  // with fewer would be a wrong time.
  constexpr std::size_t kRecordedDecimals = 9;
  const bool is_recorded = rows.size() == 1 || Decimals(rows[rows.size() - 2]) == kRecordedDecimals;
  return is_recorded && Decimals(rows.back()) < kRecordedDecimals;
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
