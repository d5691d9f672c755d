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

/// One bit per pixel, with the box that holds all set bits. Word-wise, so that erosion costs a few
/// operations per 64 pixels.
template <int kMaxWidth, int kMaxHeight>
class PixelMask {
 public:
  using Word = std::uint64_t;
  static constexpr int kBits = 64;
  static constexpr int kWordsPerRow = (kMaxWidth + kBits - 1) / kBits;
  using Row = std::array<Word, static_cast<std::size_t>(kWordsPerRow)>;

  /// Clears the mask for an image of the given size (within the capacity; checked by CheckFrame()).
  void Start(int width_px, int height_px) noexcept {
    width_px_ = width_px;
    height_px_ = height_px;
    box_ = {};
    count_ = 0;
    for (int v = 0; v < height_px; ++v) row(v).fill(0);
  }

  /// Marks the pixels [u_begin, u_end) of row v.
  void SetRun(int v, int u_begin, int u_end) noexcept {
    ForEachWord(u_begin, u_end, [this, v](std::size_t word, Word bits) { row(v)[word] |= bits; });
  }
  void ClearRun(int v, int u_begin, int u_end) noexcept {
    ForEachWord(u_begin, u_end, [this, v](std::size_t word, Word bits) { row(v)[word] &= ~bits; });
  }

  /// To be called after the last SetRun() or ClearRun(): finds the box and the number of pixels.
  void Finish() noexcept {
    box_ = {width_px_, height_px_, 0, 0};
    count_ = 0;
    for (int v = 0; v < height_px_; ++v) {
      int first = -1;
      int last = -1;
      for (int w = 0; w < kWordsPerRow; ++w) {
        const Word bits = row(v)[static_cast<std::size_t>(w)];
        if (bits == 0) continue;
        count_ += std::popcount(bits);
        if (first < 0) first = w * kBits + std::countr_zero(bits);
        last = w * kBits + kBits - 1 - std::countl_zero(bits);
      }
      if (first < 0) continue;
      box_.u_min = std::min(box_.u_min, first);
      box_.u_max = std::max(box_.u_max, last + 1);
      box_.v_min = std::min(box_.v_min, v);
      box_.v_max = v + 1;
    }
    if (count_ == 0) box_ = {};
  }

  /// Makes this the erosion of `source` by a square of (2 radius + 1) pixels; the image border
  /// counts as outside.
  void Erode(const PixelMask& source, int radius_px) noexcept {
    Start(source.width_px_, source.height_px_);
    const PixelBox box = source.box_;
    for (int v = box.v_min + radius_px; v < box.v_max - radius_px; ++v) {
      Row bits = source.row(v);
      for (int dv = -radius_px; dv <= radius_px; ++dv) {
        for (int w = 0; w < kWordsPerRow; ++w) {
          bits[static_cast<std::size_t>(w)] &= source.row(v + dv)[static_cast<std::size_t>(w)];
        }
      }
      for (int step = 0; step < radius_px; ++step) bits = ErodeRow(bits);
      row(v) = bits;
    }
    Finish();
  }

  [[nodiscard]] bool Test(int u, int v) const noexcept {
    if (u < 0 || v < 0 || u >= width_px_ || v >= height_px_) return false;
    return (row(v)[static_cast<std::size_t>(u / kBits)] >> (u % kBits)) & 1U;
  }

  [[nodiscard]] const PixelBox& box() const noexcept { return box_; }
  [[nodiscard]] int count() const noexcept { return count_; }
  [[nodiscard]] int width_px() const noexcept { return width_px_; }
  [[nodiscard]] int height_px() const noexcept { return height_px_; }
  [[nodiscard]] const Row& row(int v) const noexcept { return rows_[static_cast<std::size_t>(v)]; }

  /// Calls visit(u) for every set pixel of row v, from left to right.
  template <class Visitor>
  void ForEachInRow(int v, Visitor&& visit) const noexcept {
    for (int w = box_.u_min / kBits; w * kBits < box_.u_max; ++w) {
      for (Word bits = row(v)[static_cast<std::size_t>(w)]; bits != 0; bits &= bits - 1) {
        visit(w * kBits + std::countr_zero(bits));
      }
    }
  }

 private:
  /// visit(index of a word, bits of it that belong to the run)
  template <class Visitor>
  static void ForEachWord(int u_begin, int u_end, Visitor&& visit) noexcept {
    for (int u = u_begin; u < u_end;) {
      const int first = u % kBits;
      const int last = std::min(kBits, first + u_end - u);
      const Word upto = last == kBits ? ~Word{0} : (Word{1} << last) - 1;
      visit(static_cast<std::size_t>(u / kBits), upto & (~Word{0} << first));
      u += last - first;
    }
  }

  [[nodiscard]] Row& row(int v) noexcept { return rows_[static_cast<std::size_t>(v)]; }

  [[nodiscard]] static Row ErodeRow(const Row& bits) noexcept {
    Row out;
    for (int w = 0; w < kWordsPerRow; ++w) {
      const auto i = static_cast<std::size_t>(w);
      const Word left = (bits[i] << 1) | (w > 0 ? bits[i - 1] >> (kBits - 1) : 0);
      const Word right = (bits[i] >> 1) | (w + 1 < kWordsPerRow ? bits[i + 1] << (kBits - 1) : 0);
      out[i] = bits[i] & left & right;
    }
    return out;
  }

  std::array<Row, static_cast<std::size_t>(kMaxHeight)> rows_;
  PixelBox box_{};
  int count_ = 0;
  int width_px_ = 0;
  int height_px_ = 0;
};

}  // namespace disflow
