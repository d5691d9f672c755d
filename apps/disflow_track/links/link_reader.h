// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "disflow/hal/byte_link.h"

namespace disflow::apps {

/// Empties a link between two frames, so that what waits there is never older than a frame and
/// other traffic cannot hide what is wanted. What is too much to be looked at is left out, the
/// oldest first.
class LinkReader {
 public:
  /// What is handed on at once at most: twice what 4 Mbaud bring in 100 ms, and hundreds of
  /// datagrams.
  static constexpr std::size_t kKept_bytes = 128 * 1024;
  /// What is taken from the link at once at most, or a sender faster than this program would hold
  /// it. More than a socket holds.
  static constexpr std::size_t kTaken_bytes = 2 * 1024 * 1024;

  LinkReader() : buffer_(2 * kKept_bytes + kPiece_bytes) {}

  /// @return All that has come in since the last call, or its end; valid until the next call.
  [[nodiscard]] std::span<const std::byte> Read(hal::ByteLink& link) noexcept;

  /// What was left out; saturating.
  [[nodiscard]] std::uint64_t dropped_bytes() const noexcept { return dropped_bytes_; }

 private:
  static constexpr std::size_t kPiece_bytes = 128 * 1024;

  /// Keeps the last kKept_bytes of so many. @return What is kept.
  [[nodiscard]] std::size_t DropOldest(std::size_t size) noexcept;

  std::vector<std::byte> buffer_;
  std::uint64_t dropped_bytes_ = 0;
};

}  // namespace disflow::apps
