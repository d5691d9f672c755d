// SPDX-License-Identifier: BSD-3-Clause
#include "links/link_reader.h"

#include <algorithm>

#include "disflow/saturating.h"

namespace disflow::apps {

std::span<const std::byte> LinkReader::Read(hal::ByteLink& link) noexcept {
  std::size_t size = 0;
  std::size_t kept = 0;
  for (std::size_t taken = 0; taken < kTaken_bytes; taken += size, kept += size) {
    if (kept + kPiece_bytes > buffer_.size()) kept = DropOldest(kept);
    const Expected<std::size_t> received =
        link.Receive(std::span(buffer_).subspan(kept, kPiece_bytes));
    // A device that is gone shows when something is sent, and that is soon.
    if (!received.ok() || received.value == 0) break;
    size = received.value;
  }
  if (kept > kKept_bytes) kept = DropOldest(kept);
  return std::span(buffer_).first(kept);
}

std::size_t LinkReader::DropOldest(std::size_t size) noexcept {
  const auto begin = buffer_.begin() + static_cast<std::ptrdiff_t>(size - kKept_bytes);
  std::copy(begin, begin + static_cast<std::ptrdiff_t>(kKept_bytes), buffer_.begin());
  AddSaturating(dropped_bytes_, size - kKept_bytes);
  return kKept_bytes;
}

}  // namespace disflow::apps
