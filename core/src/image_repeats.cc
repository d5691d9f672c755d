// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/image_repeats.h"

#include <cstddef>
#include <cstring>

namespace disflow {
namespace {

constexpr int kRowStep = 4;

/// The hash FNV-1a, over words of eight bytes.
class Fingerprint {
 public:
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

  void AddRow(const std::byte* row, std::size_t bytes) noexcept {
    std::size_t at = 0;
    // Copies of a size that the compiler knows are single loads.
    for (; at + kWord <= bytes; at += kWord) {
      std::uint64_t word = 0;
      std::memcpy(&word, row + at, kWord);
      Add(word);
    }
    if (at == bytes) return;
    std::uint64_t rest = 0;
    std::memcpy(&rest, row + at, bytes - at);
    Add(rest);
  }

 private:
  static constexpr std::size_t kWord = sizeof(std::uint64_t);
  static constexpr std::uint64_t kPrime = 0x100000001B3U;

  void Add(std::uint64_t word) noexcept {
    value_ = (value_ ^ word) * kPrime;
    // A product carries upwards only.
    value_ ^= value_ >> 32U;
  }

  std::uint64_t value_ = 0xCBF29CE484222325U;
};

std::uint64_t FingerprintOf(const DepthView& depth) noexcept {
  Fingerprint fingerprint;
  const auto bytes = static_cast<std::size_t>(depth.width_px * depth.bytes_per_pixel());
  for (int v = 0; v < depth.height_px; v += kRowStep) fingerprint.AddRow(depth.row(v), bytes);
  return fingerprint.value();
}

}  // namespace

bool ImageRepeats::IsRepeat(const DepthView& depth, StampNs stamp_ns) noexcept {
  const std::uint64_t fingerprint = FingerprintOf(depth);
  if (has_image_ && fingerprint == fingerprint_) return true;
  has_image_ = true;
  fingerprint_ = fingerprint;
  first_ns_ = stamp_ns;
  return false;
}

}  // namespace disflow
