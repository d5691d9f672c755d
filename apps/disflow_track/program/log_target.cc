// SPDX-License-Identifier: BSD-3-Clause
#include "program/log_target.h"

#include <poll.h>

#include <cerrno>
#include <cstdio>

#include "disflow/posix/journal.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

void WriteText(std::string_view text) noexcept {
  (void)std::fwrite(text.data(), 1, text.size(), stderr);
  (void)std::fflush(stderr);
}

/// Of an entry, whose first field it is.
std::string_view MessageOf(std::string_view entry) noexcept {
  constexpr std::string_view kText = "MESSAGE=";
  constexpr std::size_t kBinary = sizeof("MESSAGE\n") - 1 + 8;
  if (entry.starts_with(kText)) return entry.substr(kText.size(), entry.find('\n') - kText.size());
  return entry.size() > kBinary ? entry.substr(kBinary, entry.find("\nPRIORITY=") - kBinary)
                                : entry;
}

posix::UnixDatagrams JournalFor(const std::string& wanted) {
  constexpr std::string_view kJournal = "journald";
  const bool is_automatic = wanted == "auto" && posix::StandardErrorIsJournal();
  if (wanted == kJournal || is_automatic) return posix::UnixDatagrams(posix::kJournalSocket);
  if (wanted == "auto" || wanted == "text") return {};
  posix::UnixDatagrams named;
  if (wanted.starts_with("journald:"))
    named = posix::UnixDatagrams(wanted.substr(kJournal.size() + 1));
  if (named.is_open()) return named;
  throw Failure(kWrongUsage, "--log " + wanted +
                                 ": auto, text, journald or journald:SOCKET is needed, the socket "
                                 "with its whole path");
}

}  // namespace

posix::JournalEntry MakeJournalEntry(std::string_view message, Severity severity,
                                     std::span<const LogField> fields) noexcept {
  posix::JournalEntry entry;
  // What follows the message finds room however long that is.
  entry.Add("MESSAGE", message.substr(0, posix::JournalEntry::kCapacity / 2))
      .Add("PRIORITY", static_cast<std::int64_t>(severity))
      .Add("SYSLOG_IDENTIFIER", "disflow_track");
  for (const LogField& field : fields) entry.Add(field.name, field.value);
  return entry;
}

LogTarget::LogTarget(const std::string& wanted) : journal_(JournalFor(wanted)) {}

void LogTarget::Write(std::string_view record) noexcept {
  constexpr int kPause_ms = 20;
  constexpr int kAttempts = 50;
  if (!is_journal()) {
    WriteText(record);
    return;
  }
  int error = journal_.Send(record);
  for (int i = 1; i < kAttempts && (error == EAGAIN || error == EINTR); ++i) {
    (void)::poll(nullptr, 0, kPause_ms);
    error = journal_.Send(record);
  }
  if (error == 0) return;
  WriteText("disflow_track: ");
  WriteText(MessageOf(record));
  WriteText("\n");
}

void LogTarget::WriteLost(std::uint32_t count) noexcept {
  std::array<char, 80> text{};
  const int length =
      std::snprintf(text.data(), text.size(), "%s%u messages were lost here%s",
                    is_journal() ? "" : "disflow_track: ", count, is_journal() ? "" : "\n");
  const std::string_view said(text.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
  Write(is_journal() ? MakeJournalEntry(said, Severity::kWarning).bytes() : said);
}

}  // namespace disflow::apps
