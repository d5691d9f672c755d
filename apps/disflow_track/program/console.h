// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

#include "program/frame_result.h"
#include "program/log_target.h"
#include "program/log_writer.h"

namespace disflow::apps {

/// Messages, on stderr or in the journal, and on a terminal one line that always shows the latest
/// state. Say() may be called by any thread.
class Console {
 public:
  /// @param live_line Show the line if stderr is a terminal.
  /// @param log Where messages go, see LogTarget. @throws Failure kWrongUsage.
  explicit Console(bool live_line, const std::string& log = "text");
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  ~Console() { ClearLine(); }

  /// From now on a thread of its own writes, and no caller waits for the terminal or the journal.
  void WriteInBackground() { writer_ = std::make_unique<LogWriter>(target_); }
  /// Whether messages have fields, for programs to read.
  [[nodiscard]] bool is_structured() const noexcept { return target_.is_journal(); }

  /// One line with the program's name ahead.
  /// @param severity, fields For the journal.
  void Say(std::string_view message, Severity severity = Severity::kInfo,
           std::span<const LogField> fields = {}) noexcept;
  /// Shows the frame, if the last one was shown a while ago.
  /// @param results One per object.
  void Show(std::span<const FrameResult> results, std::int64_t now_ns) noexcept;
  void ClearLine() noexcept;

 private:
  void Paint(std::span<const FrameResult> results, double seconds) noexcept;
  void Write(std::string_view text) noexcept;

  LogTarget target_;
  bool live_line_;
  std::mutex mutex_;
  bool line_shown_ = false;
  // Since the line was painted.
  std::int64_t painted_ns_ = 0;
  int frames_ = 0;
  std::int64_t total_ns_ = 0;
  std::array<std::int64_t, kStageCount> stage_ns_{};
  std::unique_ptr<LogWriter> writer_;  ///< Null: whoever says something writes it.
};

}  // namespace disflow::apps
