// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/journal.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>

namespace disflow::posix {
namespace {

/// Of a value that follows: 64 bits, little endian.
using Length = std::array<char, 8>;

Length LengthOf(std::size_t size) noexcept {
  Length length{};
  for (std::size_t i = 0; i < length.size(); ++i)
    length[i] = static_cast<char>((std::uint64_t{size} >> (8 * i)) & 0xFF);
  return length;
}

}  // namespace

JournalEntry& JournalEntry::Add(std::string_view name, std::string_view value) noexcept {
  // Name, line break, length, value, line break.
  const std::size_t around = name.size() + sizeof(Length) + 2;
  const std::size_t room = kCapacity - size_;
  if (room <= around) return *this;
  value = value.substr(0, std::min(value.size(), room - around));
  Append(name);
  if (value.find('\n') == std::string_view::npos) {
    Append("=");
  } else {
    const Length length = LengthOf(value.size());
    Append("\n");
    Append({length.data(), length.size()});
  }
  Append(value);
  Append("\n");
  return *this;
}

JournalEntry& JournalEntry::Add(std::string_view name, std::int64_t value) noexcept {
  std::array<char, 24> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  (void)error;  // 24 characters hold every number
  return Add(name, {text.data(), static_cast<std::size_t>(end - text.data())});
}

void JournalEntry::Append(std::string_view text) noexcept {
  std::memcpy(bytes_.data() + size_, text.data(), text.size());
  size_ += text.size();
}

bool StandardErrorIsJournal() noexcept {
  const char* const stream = std::getenv("JOURNAL_STREAM");
  struct stat info {};
  if (stream == nullptr || ::fstat(STDERR_FILENO, &info) != 0) return false;
  const std::string_view text = stream;
  std::uint64_t device = 0;
  std::uint64_t inode = 0;
  const char* const last = text.data() + text.size();
  const auto [colon, error] = std::from_chars(text.data(), last, device);
  if (error != std::errc{} || colon == last || *colon != ':') return false;
  const auto [end, inode_error] = std::from_chars(colon + 1, last, inode);
  return inode_error == std::errc{} && end == last && device == info.st_dev && inode == info.st_ino;
}

}  // namespace disflow::posix
