// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/image_repeats.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace disflow {
namespace {

constexpr int kRowStep = 4;

/// Two sums of products of 32 bits, which a small processor multiplies in one step.
class Fingerprint {
 public:
  void Add(std::uint32_t word) noexcept {
    a_ = (a_ ^ word) * 0x01000193U;
    b_ = (b_ + word) * 0x85EBCA6BU;
    b_ ^= b_ >> 15U;
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return (std::uint64_t{a_} << 32U) | b_; }

 private:
  std::uint32_t a_ = 0x811C9DC5U;
  std::uint32_t b_ = 0x9E3779B9U;
};

std::uint64_t FingerprintOf(const DepthView& depth) noexcept {
  Fingerprint fingerprint;
  const auto bytes = static_cast<std::size_t>(depth.width_px * depth.bytes_per_pixel());
  for (int v = 0; v < depth.height_px; v += kRowStep) {
    const std::byte* row = depth.row(v);
    // A word at a time; the last may be a part of one.
    for (std::size_t at = 0; at < bytes; at += sizeof(std::uint32_t)) {
      std::uint32_t word = 0;
      std::memcpy(&word, row + at, std::min(sizeof word, bytes - at));
      fingerprint.Add(word);
    }
  }
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
