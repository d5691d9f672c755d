// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/image_repeats.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace disflow {
namespace {

constexpr int kRowStep = 4;

/// The hash FNV-1a, over words of eight bytes.
std::uint64_t FingerprintOf(const DepthView& depth) noexcept {
  constexpr std::uint64_t kPrime = 0x100000001B3U;
  std::uint64_t fingerprint = 0xCBF29CE484222325U;
  const auto bytes = static_cast<std::size_t>(depth.width_px * depth.bytes_per_pixel());
  for (int v = 0; v < depth.height_px; v += kRowStep) {
    const std::byte* row = depth.row(v);
    // The last word of a row may be a part of one.
    for (std::size_t at = 0; at < bytes; at += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, row + at, std::min(sizeof word, bytes - at));
      fingerprint = (fingerprint ^ word) * kPrime;
      // A product carries upwards only.
      fingerprint ^= fingerprint >> 32U;
    }
  }
  return fingerprint;
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
