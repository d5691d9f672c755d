// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string_view>
#include <thread>

#include "disflow/posix/journal.h"
#include "program/log_target.h"

namespace disflow::apps {

/// Writes messages in a thread of its own, so that nobody waits for a terminal or for a journal
/// that does not read. Records that find no room are counted and the number is said.
class LogWriter {
 public:
  /// @param target Outlives the writer.
  explicit LogWriter(LogTarget& target);
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;
  /// Writes what is waiting.
  ~LogWriter();

  /// Takes a record as LogTarget::Write() does; cut at kLongest. Never waits for the output.
  void Push(std::string_view text) noexcept;

 private:
  static constexpr std::size_t kEntries = 64;
  static constexpr std::size_t kLongest = posix::JournalEntry::kCapacity;

  struct Entry {
    std::array<char, kLongest> text{};
    std::size_t size = 0;
  };

  void WriteAll();

  LogTarget& target_;
  std::mutex mutex_;
  std::condition_variable changed_;
  // Under the mutex.
  std::array<Entry, kEntries> entries_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::uint32_t lost_ = 0;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace disflow::apps
