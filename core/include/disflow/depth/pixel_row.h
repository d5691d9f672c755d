// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace disflow {

/// Rectangle of pixels, half open: [u_min, u_max) x [v_min, v_max).
struct PixelBox {
  int u_min = 0;
  int v_min = 0;
  int u_max = 0;
  int v_max = 0;

  [[nodiscard]] bool empty() const noexcept { return u_min >= u_max || v_min >= v_max; }
  [[nodiscard]] int width() const noexcept { return u_max - u_min; }
  [[nodiscard]] int height() const noexcept { return v_max - v_min; }
};

/// What two boxes have in common; empty if that is nothing.
[[nodiscard]] inline PixelBox Common(const PixelBox& a, const PixelBox& b) noexcept {
  const PixelBox common{std::max(a.u_min, b.u_min), std::max(a.v_min, b.v_min),
                        std::min(a.u_max, b.u_max), std::min(a.v_max, b.v_max)};
  return common.empty() ? PixelBox{} : common;
}

/// One bit per pixel of an image row.
template <int kMaxWidth>
struct PixelRow {
  using Word = std::uint64_t;
  static constexpr int kBits = 64;
  static constexpr int kWords = (kMaxWidth + kBits - 1) / kBits;
  std::array<Word, static_cast<std::size_t>(kWords)> words;

  [[nodiscard]] Word& operator[](int w) noexcept { return words[static_cast<std::size_t>(w)]; }
  [[nodiscard]] Word operator[](int w) const noexcept { return words[static_cast<std::size_t>(w)]; }
  void Clear() noexcept { words.fill(0); }

  /// Marks the pixels [u_begin, u_end).
  void SetRun(int u_begin, int u_end) noexcept {
    ForEachWord(u_begin, u_end, [this](int w, Word bits) { (*this)[w] |= bits; });
  }
  void ClearRun(int u_begin, int u_end) noexcept {
    ForEachWord(u_begin, u_end, [this](int w, Word bits) { (*this)[w] &= ~bits; });
  }
  /// Marks those of the pixels [u_begin, u_end) that another row has marked.
  void AddRun(const PixelRow& other, int u_begin, int u_end) noexcept {
    ForEachWord(u_begin, u_end, [&](int w, Word bits) { (*this)[w] |= other[w] & bits; });
  }
  /// Marked pixels in [u_begin, u_end).
  [[nodiscard]] int CountRun(int u_begin, int u_end) const noexcept {
    int count = 0;
    ForEachWord(u_begin, u_end,
                [&](int w, Word bits) { count += std::popcount((*this)[w] & bits); });
    return count;
  }
  /// The pixels [u, u + count) as bits, the first one lowest.
  /// @param count From 1 to 63.
  [[nodiscard]] Word Bits(int u, int count) const noexcept {
    const int first = u % kBits;
    Word bits = (*this)[u / kBits] >> first;
    if (first + count > kBits) bits |= (*this)[u / kBits + 1] << (kBits - first);
    return bits & ((Word{1} << count) - 1);
  }
  [[nodiscard]] bool Test(int u) const noexcept { return ((*this)[u / kBits] >> (u % kBits)) & 1U; }

  /// visit(begin, end) for every stretch of [u_begin, u_end) whose pixels are not marked.
  template <class Visitor>
  void ForEachGap(int u_begin, int u_end, Visitor&& visit) const noexcept {
    for (int u = Next<false>(u_begin, u_end); u < u_end; u = Next<false>(u, u_end)) {
      const int begin = u;
      u = Next<true>(begin, u_end);
      visit(begin, u);
    }
  }

  /// Words [w_begin, w_end) of every pixel's own, its left and its right neighbour's bit, combined
  /// by `Combine`; bits outside of those words count as 0.
  template <class Combine>
  void Neighbours(int w_begin, int w_end, Combine&& combine) noexcept {
    Word before = 0;
    for (int w = w_begin; w < w_end; ++w) {
      const Word own = (*this)[w];
      const Word after = w + 1 < w_end ? (*this)[w + 1] : 0;
      (*this)[w] =
          combine(own, (own << 1) | (before >> (kBits - 1)), (own >> 1) | (after << (kBits - 1)));
      before = own;
    }
  }

  /// Marks the pixels `step` (at most 63) to the left and to the right of marked ones as well,
  /// within the words [w_begin, w_end).
  void Spread(int w_begin, int w_end, int step) noexcept {
    Word before = 0;
    for (int w = w_begin; w < w_end; ++w) {
      const Word own = (*this)[w];
      const Word after = w + 1 < w_end ? (*this)[w + 1] : 0;
      (*this)[w] = own | (own << step) | (before >> (kBits - step)) | (own >> step) |
                   (after << (kBits - step));
      before = own;
    }
  }

 private:
  /// The first pixel in [u, u_end) that is marked, or is not; u_end if there is none.
  template <bool kMarked>
  [[nodiscard]] int Next(int u, int u_end) const noexcept {
    while (u < u_end) {
      const Word word = (*this)[u / kBits];
      const Word bits = (kMarked ? word : ~word) >> (u % kBits);
      if (bits != 0) return std::min(u + std::countr_zero(bits), u_end);
      u += kBits - u % kBits;
    }
    return u_end;
  }

  /// visit(index of a word, bits of it that belong to the run)
  template <class Visitor>
  static void ForEachWord(int u_begin, int u_end, Visitor&& visit) noexcept {
    for (int u = u_begin; u < u_end;) {
      const int first = u % kBits;
      const int last = std::min(kBits, first + u_end - u);
      const Word upto = last == kBits ? ~Word{0} : (Word{1} << last) - 1;
      visit(u / kBits, upto & (~Word{0} << first));
      u += last - first;
    }
  }
};

}  // namespace disflow
