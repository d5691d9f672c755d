// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/image_repeats.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace disflow {
namespace {

constexpr int kRowStep = 4;

/// In the manner of the hash FNV-1a, over words of eight bytes in four lanes, none of which waits
/// for another.
class Fingerprint {
 public:
  [[nodiscard]] std::uint64_t value() const noexcept {
    std::uint64_t value = 0;
    for (const std::uint64_t lane : lanes_) value = Mixed(value, lane);
    return value;
  }

  void AddRow(const std::byte* row, std::size_t bytes) noexcept {
    Lanes lanes = lanes_;
    Lanes words;
    std::size_t at = 0;
    // Copies of a size that the compiler knows are single loads.
    for (; at + sizeof words <= bytes; at += sizeof words) {
      std::memcpy(words.data(), row + at, sizeof words);
      for (std::size_t i = 0; i < words.size(); ++i) lanes[i] = Mixed(lanes[i], words[i]);
    }
    if (at < bytes) {
      words.fill(0);
      std::memcpy(words.data(), row + at, bytes - at);
      for (std::size_t i = 0; i < words.size(); ++i) lanes[i] = Mixed(lanes[i], words[i]);
    }
    lanes_ = lanes;
  }

 private:
  using Lanes = std::array<std::uint64_t, 4>;

  /// A product carries upwards only, so its upper half goes below before the next one.
  [[nodiscard]] static std::uint64_t Mixed(std::uint64_t value, std::uint64_t word) noexcept {
    constexpr std::uint64_t kPrime = 0x100000001B3U;
    return std::rotl((value ^ word) * kPrime, 32);
  }

  Lanes lanes_{0xCBF29CE484222325U, 0x84222325CBF29CE4U, 0x2325CBF29CE48422U, 0x9CE484222325CBF2U};
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
