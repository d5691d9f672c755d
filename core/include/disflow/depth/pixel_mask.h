// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "disflow/depth/pixel_row.h"

namespace disflow {

/// One bit per pixel, with the box that holds all set bits. Word-wise, so that morphology costs a
/// few operations per 64 pixels.
template <int kMaxWidth, int kMaxHeight>
class PixelMask {
 public:
  using Row = PixelRow<kMaxWidth>;
  using Word = typename Row::Word;
  static constexpr int kBits = Row::kBits;

  /// Clears the mask for an image of the given size (within the capacity; checked by CheckFrame()).
  void Start(int width_px, int height_px) noexcept {
    width_px_ = width_px;
    height_px_ = height_px;
    box_ = {};
    count_ = 0;
    for (int v = 0; v < height_px; ++v) std::fill_n(row(v).words.begin(), words(), Word{0});
  }

  [[nodiscard]] Row& row(int v) noexcept { return rows_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] const Row& row(int v) const noexcept { return rows_[static_cast<std::size_t>(v)]; }

  /// Marks the pixels of [u_begin, u_end) in row v that are `label` in a row of bytes.
  /// @param label 0: those that are not 0.
  void SetFromBytes(int v, int u_begin, int u_end, const std::uint8_t* bytes,
                    std::uint8_t label = 0) noexcept {
    if (label == 0) {
      SetBytesThat<false>(v, u_begin, u_end, bytes, 0);
    } else {
      SetBytesThat<true>(v, u_begin, u_end, bytes, label);
    }
  }

  /// To be called after the last change of a row: finds the box and the number of pixels.
  void Finish() noexcept {
    box_ = {width_px_, height_px_, 0, 0};
    count_ = 0;
    for (int v = 0; v < height_px_; ++v) AddRow(row(v), v, 0, words(), box_, count_);
    if (count_ == 0) box_ = {};
  }

  /// Fills gaps and notches of up to 2 radius pixels: dilation, then erosion by a square.
  /// @pre Finish() was called; to be called again afterwards.
  template <int kRadius>
  void Close() noexcept {
    constexpr int kRing = 2 * kRadius + 1;
    std::array<Row, static_cast<std::size_t>(kRing)> ring;  // dilated rows v - radius to v + radius
    const auto slot = [&ring](int v) -> Row& {
      return ring[static_cast<std::size_t>((v + kRing) % kRing)];
    };
    const int w_begin = std::max(box_.u_min - kRadius, 0) / kBits;
    const int w_end = (std::min(box_.u_max + kRadius, width_px_) + kBits - 1) / kBits;
    const auto dilate = [&](int v) {
      Row& out = slot(v);
      out.Clear();
      for (int r = std::max(v - kRadius, box_.v_min); r <= std::min(v + kRadius, box_.v_max - 1);
           ++r) {
        for (int w = w_begin; w < w_end; ++w) out[w] |= row(r)[w];
      }
      for (int i = 0; i < kRadius; ++i)
        out.Neighbours(w_begin, w_end, [](Word own, Word a, Word b) { return own | a | b; });
    };
    for (int v = box_.v_min - kRadius; v < box_.v_min + kRadius; ++v) dilate(v);
    for (int v = box_.v_min; v < box_.v_max; ++v) {
      dilate(v + kRadius);
      Row closed = slot(v);
      for (int dv = -kRadius; dv <= kRadius; ++dv) {
        for (int w = w_begin; w < w_end; ++w) closed[w] &= slot(v + dv)[w];
      }
      for (int i = 0; i < kRadius; ++i)
        closed.Neighbours(w_begin, w_end, [](Word own, Word a, Word b) { return own & a & b; });
      for (int w = w_begin; w < w_end; ++w) row(v)[w] |= closed[w];
    }
  }

  [[nodiscard]] bool Test(int u, int v) const noexcept {
    // Negative ones become large.
    if (static_cast<unsigned>(u) >= static_cast<unsigned>(width_px_) ||
        static_cast<unsigned>(v) >= static_cast<unsigned>(height_px_))
      return false;
    return row(v).Test(u);
  }

  [[nodiscard]] const PixelBox& box() const noexcept { return box_; }
  [[nodiscard]] int count() const noexcept { return count_; }
  [[nodiscard]] int width_px() const noexcept { return width_px_; }
  [[nodiscard]] int height_px() const noexcept { return height_px_; }
  /// Words of a row that the image reaches; the others have no meaning.
  [[nodiscard]] int words() const noexcept { return (width_px_ + kBits - 1) / kBits; }

  /// The pixels [u_begin, u_begin + count) of row v as bits, the first one lowest; none is set
  /// outside of the image.
  [[nodiscard]] Word BitsIn(int v, int u_begin, int count) const noexcept {
    if (v < 0 || v >= height_px_) return 0;
    const int begin = std::max(u_begin, 0);
    const int end = std::min(u_begin + count, width_px_);
    return begin < end ? row(v).Bits(begin, end - begin) << (begin - u_begin) : 0;
  }

  /// Calls visit(u) for every set pixel of row v one of whose four neighbours is not set, from left
  /// to right. The image border counts as not set.
  template <class Visitor>
  void ForEachOutlineInRow(int v, Visitor&& visit) const noexcept {
    const int w_begin = box_.u_min / kBits;
    const int w_end = (box_.u_max + kBits - 1) / kBits;
    Row inner;
    for (int w = w_begin; w < w_end; ++w) inner[w] = row(v)[w];
    inner.Neighbours(w_begin, w_end, [](Word own, Word a, Word b) { return own & a & b; });
    const bool at_border = v == 0 || v == height_px_ - 1;
    for (int w = w_begin; w < w_end; ++w) {
      const Word hidden = at_border ? 0 : inner[w] & row(v - 1)[w] & row(v + 1)[w];
      VisitBits(row(v)[w] & ~hidden, w, visit);
    }
  }

  /// visit(u) for every bit that is set in word w of a row.
  template <class Visitor>
  static void VisitBits(Word bits, int w, Visitor&& visit) noexcept {
    for (; bits != 0; bits &= bits - 1) visit(w * kBits + std::countr_zero(bits));
  }

  /// Extends a box and a count by the pixels of a row.
  static void AddRow(const Row& bits, int v, int w_begin, int w_end, PixelBox& box,
                     int& count) noexcept {
    int first = -1;
    int last = -1;
    for (int w = w_begin; w < w_end; ++w) {
      if (bits[w] == 0) continue;
      // Most words are full, and counting calls a function on many processors.
      count += bits[w] == ~Word{0} ? kBits : std::popcount(bits[w]);
      if (first < 0) first = w * kBits + std::countr_zero(bits[w]);
      last = w * kBits + kBits - 1 - std::countl_zero(bits[w]);
    }
    if (first < 0) return;
    box.u_min = std::min(box.u_min, first);
    box.u_max = std::max(box.u_max, last + 1);
    box.v_min = std::min(box.v_min, v);
    box.v_max = v + 1;
  }

 private:
  /// Marks what equals the value, or what differs from it.
  template <bool kEqual>
  void SetBytesThat(int v, int u_begin, int u_end, const std::uint8_t* bytes,
                    std::uint8_t value) noexcept {
    const auto wanted = [value](std::uint8_t byte) { return (byte == value) == kEqual; };
    int u = u_begin;
    for (; u < u_end && u % kBits != 0; ++u) SetBit(v, u, wanted(bytes[u]));
    for (; u + kBits <= u_end; u += kBits) {
      // Most of an image is not the object. (All of it zero is no label either: labels are not 0.)
      if (AreZero(bytes + u)) {
        row(v)[u / kBits] = 0;
        continue;
      }
      Word bits = 0;
      for (int i = 0; i < kBits; i += 8) {
        bits |= DifferingBytes<kEqual>(bytes + u + i, value) << i;
      }
      row(v)[u / kBits] = kEqual ? ~bits : bits;
    }
    for (; u < u_end; ++u) SetBit(v, u, wanted(bytes[u]));
  }

  /// Whether the bytes of a whole word of pixels are all 0.
  [[nodiscard]] static bool AreZero(const std::uint8_t* bytes) noexcept {
    std::array<Word, static_cast<std::size_t>(kBits) / sizeof(Word)> eights;
    std::memcpy(eights.data(), bytes, sizeof eights);
    Word any = 0;
    for (const Word eight : eights) any |= eight;
    return any == 0;
  }

  void SetBit(int v, int u, bool on) noexcept {
    if (on) row(v)[u / kBits] |= Word{1} << (u % kBits);
  }

  /// Eight bytes as eight bits, 1 where a byte is not the value.
  /// @tparam kHasValue false: the value is 0.
  template <bool kHasValue>
  [[nodiscard]] static Word DifferingBytes(const std::uint8_t* bytes, std::uint8_t value) noexcept {
    if constexpr (std::endian::native == std::endian::little) {
      constexpr Word kLow7 = 0x7F7F7F7F7F7F7F7FULL;
      Word word = 0;
      std::memcpy(&word, bytes, sizeof word);
      if constexpr (kHasValue) word ^= Word{value} * 0x0101010101010101ULL;
      const Word top_bits = (((word & kLow7) + kLow7) | word) & ~kLow7;
      return ((top_bits >> 7) * 0x0102040810204080ULL) >> 56;
    } else {
      Word bits = 0;
      for (int i = 0; i < 8; ++i) bits |= Word{bytes[i] != value} << i;
      return bits;
    }
  }

  std::array<Row, static_cast<std::size_t>(kMaxHeight)> rows_;
  PixelBox box_{};
  int count_ = 0;
  int width_px_ = 0;
  int height_px_ = 0;
};

}  // namespace disflow
