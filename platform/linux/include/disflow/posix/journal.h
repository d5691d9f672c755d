// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "disflow/posix/unix_datagrams.h"

/// @file
/// The native protocol of systemd's journal (systemd.io/JOURNAL_NATIVE_PROTOCOL), without its
/// library: libsystemd's sd_journal_send() waits for a journal that does not read and knows one
/// socket only.

namespace disflow::posix {

/// One entry in fixed memory.
class JournalEntry {
 public:
  static constexpr std::size_t kCapacity = 2048;

  /// Adds a field; a value that finds no room is cut, a field that finds none is left out.
  /// @param name Upper-case letters, digits and underscores, as the journal demands.
  /// @param value Any bytes.
  JournalEntry& Add(std::string_view name, std::string_view value) noexcept;
  JournalEntry& Add(std::string_view name, std::int64_t value) noexcept;
  [[nodiscard]] std::string_view bytes() const noexcept { return {bytes_.data(), size_}; }

 private:
  void Append(std::string_view text) noexcept;

  std::array<char, kCapacity> bytes_;
  std::size_t size_ = 0;
};

inline constexpr std::string_view kJournalSocket = "/run/systemd/journal/socket";

/// Whether standard error is a stream of the journal's, so that what is sent natively stands beside
/// it: JOURNAL_STREAM in the environment names its device and inode.
[[nodiscard]] bool StandardErrorIsJournal() noexcept;

}  // namespace disflow::posix
