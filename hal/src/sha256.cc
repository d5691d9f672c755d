// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/sha256.h"

#include <algorithm>
#include <bit>

namespace disflow::hal {
namespace {

/// FIPS 180-4, 4.2.2.
constexpr std::array<std::uint32_t, 64> kRoundConstants{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

// The functions of FIPS 180-4, 4.1.2.
constexpr std::uint32_t Choose(std::uint32_t x, std::uint32_t y, std::uint32_t z) noexcept {
  return (x & y) ^ (~x & z);
}
constexpr std::uint32_t Majority(std::uint32_t x, std::uint32_t y, std::uint32_t z) noexcept {
  return (x & y) ^ (x & z) ^ (y & z);
}
constexpr std::uint32_t BigSigma0(std::uint32_t x) noexcept {
  return std::rotr(x, 2) ^ std::rotr(x, 13) ^ std::rotr(x, 22);
}
constexpr std::uint32_t BigSigma1(std::uint32_t x) noexcept {
  return std::rotr(x, 6) ^ std::rotr(x, 11) ^ std::rotr(x, 25);
}
constexpr std::uint32_t SmallSigma0(std::uint32_t x) noexcept {
  return std::rotr(x, 7) ^ std::rotr(x, 18) ^ (x >> 3U);
}
constexpr std::uint32_t SmallSigma1(std::uint32_t x) noexcept {
  return std::rotr(x, 17) ^ std::rotr(x, 19) ^ (x >> 10U);
}

/// The standard's numbers have their high byte first.
constexpr std::uint32_t LoadBigEndian(std::span<const std::byte, 4> bytes) noexcept {
  std::uint32_t value = 0;
  for (const std::byte byte : bytes) value = (value << 8U) | std::to_integer<std::uint32_t>(byte);
  return value;
}
template <class T>
constexpr void StoreBigEndian(T value, std::span<std::byte, sizeof(T)> out) noexcept {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    out[i] = static_cast<std::byte>(value >> (8 * (sizeof(T) - 1 - i)));
  }
}

/// FIPS 180-4, 6.2.2, step 1.
using Schedule = std::array<std::uint32_t, 64>;
void Expand(std::span<const std::byte, 64> block, Schedule& w) noexcept {
  for (std::size_t t = 0; t < 16; ++t) {
    w[t] = LoadBigEndian(std::span<const std::byte, 4>(block.subspan(4 * t, 4)));
  }
  for (std::size_t t = 16; t < w.size(); ++t) {
    w[t] = SmallSigma1(w[t - 2]) + w[t - 7] + SmallSigma0(w[t - 15]) + w[t - 16];
  }
}

}  // namespace

void Sha256::Add(std::span<const std::byte> bytes) noexcept {
  while (!bytes.empty()) {
    const auto filled = static_cast<std::size_t>(size_ % kBlockSize);
    const std::size_t taken = std::min(bytes.size(), kBlockSize - filled);
    std::copy_n(bytes.begin(), taken, block_.begin() + static_cast<std::ptrdiff_t>(filled));
    size_ += taken;
    bytes = bytes.subspan(taken);
    if (size_ % kBlockSize == 0) DigestBlock(block_);
  }
}

Sha256::Digest Sha256::Finish() noexcept {
  // FIPS 180-4, 5.1.1: a one bit, zeros, and the number of bits at the end of a block.
  constexpr std::size_t kLengthAt = kBlockSize - sizeof(std::uint64_t);
  const std::uint64_t size_bits = 8 * size_;
  constexpr std::array kOne{std::byte{0x80}};
  constexpr std::array kZero{std::byte{0}};
  Add(kOne);
  while (size_ % kBlockSize != kLengthAt) Add(kZero);
  std::array<std::byte, sizeof(std::uint64_t)> length;
  StoreBigEndian(size_bits, std::span(length));
  Add(length);

  Digest digest;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    StoreBigEndian(state_[i], std::span<std::byte, 4>(std::span(digest).subspan(4 * i, 4)));
  }
  return digest;
}

/// FIPS 180-4, 6.2.2.
void Sha256::DigestBlock(std::span<const std::byte, kBlockSize> block) noexcept {
  Schedule w;
  Expand(block, w);
  auto [a, b, c, d, e, f, g, h] = state_;
  for (std::size_t t = 0; t < w.size(); ++t) {
    const std::uint32_t t1 = h + BigSigma1(e) + Choose(e, f, g) + kRoundConstants[t] + w[t];
    const std::uint32_t t2 = BigSigma0(a) + Majority(a, b, c);
    h = g;
    g = f;
    f = e;
    e = d + t1;
    d = c;
    c = b;
    b = a;
    a = t1 + t2;
  }
  const std::array<std::uint32_t, 8> more{a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < state_.size(); ++i) state_[i] += more[i];
}

}  // namespace disflow::hal
