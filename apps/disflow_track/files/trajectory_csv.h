// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "files/output_file.h"
#include "program/frame_result.h"

namespace disflow::apps {

/// The trajectory: one row per input frame, columns as in docs/outputs.md. Writing does not
/// allocate.
class TrajectoryCsv {
 public:
  /// Writes the header. @throws Failure kOutputFailed.
  /// @param timing false: the time columns are 0, so that two runs give the same bytes.
  TrajectoryCsv(const std::string& path, bool timing);

  /// @return false if the file is not complete, see file().
  [[nodiscard]] bool Write(const FrameResult& result) noexcept;
  [[nodiscard]] const RecordFile& file() const noexcept { return file_; }

 private:
  RecordFile file_;
  bool timing_;
};

}  // namespace disflow::apps
