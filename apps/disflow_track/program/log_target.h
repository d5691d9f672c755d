// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "disflow/posix/journal.h"
#include "disflow/posix/unix_datagrams.h"

namespace disflow::apps {

/// How much a message matters; the numbers are those of syslog and the journal.
enum class Severity : std::uint8_t { kError = 3, kWarning = 4, kNotice = 5, kInfo = 6 };

/// What a program that reads the journal finds beside a message.
struct LogField {
  std::string_view name;  ///< "DISFLOW_STATE".
  std::string_view value;
};

/// A message as the journal takes it.
[[nodiscard]] posix::JournalEntry MakeJournalEntry(std::string_view message, Severity severity,
                                                   std::span<const LogField> fields = {}) noexcept;

/// Where messages go: to standard error as lines, or to systemd's journal as entries with fields.
class LogTarget {
 public:
  /// @param wanted "text"; "journald", or "journald:SOCKET" for another one than the system's;
  /// "auto": the journal if standard error is a stream of its.
  /// @throws Failure kWrongUsage for other words.
  explicit LogTarget(const std::string& wanted);

  [[nodiscard]] bool is_journal() const noexcept { return journal_.is_open(); }
  /// Writes a text, or sends an entry as JournalEntry makes it. An entry that the journal does not
  /// take within a second goes to standard error; only its message.
  void Write(std::string_view record) noexcept;
  /// Says that so many messages found no room here.
  void WriteLost(std::uint32_t count) noexcept;

 private:
  posix::UnixDatagrams journal_;
};

}  // namespace disflow::apps
