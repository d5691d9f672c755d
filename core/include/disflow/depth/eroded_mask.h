// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/depth/pixel_mask.h"

namespace disflow {

/// The erosion of a mask by a square of (2 radius + 1) pixels, computed row by row when it is read:
/// no second mask is stored. The image border counts as outside.
template <class Mask>
class ErodedMask {
 public:
  using Row = typename Mask::Row;

  /// @param source Must not change while this is used.
  ErodedMask(const Mask& source, int radius_px) noexcept
      : source_(source),
        radius_px_(radius_px),
        w_begin_(source.box().u_min / Mask::kBits),
        w_end_((source.box().u_max + Mask::kBits - 1) / Mask::kBits) {
    box_ = {source.width_px(), source.height_px(), 0, 0};
    for (int v = source.box().v_min + radius_px; v < source.box().v_max - radius_px; ++v)
      Mask::AddRow(RowAt(v), v, w_begin_, w_end_, box_, count_);
    if (count_ == 0) box_ = {};
  }

  [[nodiscard]] const PixelBox& box() const noexcept { return box_; }
  [[nodiscard]] int count() const noexcept { return count_; }

  /// Row v, inside of box(); what is beside the box has no meaning.
  [[nodiscard]] Row RowAt(int v) const noexcept {
    using Word = typename Mask::Word;
    Row bits;
    for (int w = w_begin_; w < w_end_; ++w) bits[w] = source_.row(v)[w];
    for (int dv = 1; dv <= radius_px_; ++dv) {
      for (int w = w_begin_; w < w_end_; ++w)
        bits[w] &= source_.row(v - dv)[w] & source_.row(v + dv)[w];
    }
    for (int step = 0; step < radius_px_; ++step)
      bits.Neighbours(w_begin_, w_end_, [](Word own, Word a, Word b) { return own & a & b; });
    return bits;
  }

 private:
  const Mask& source_;
  int radius_px_;
  int w_begin_;
  int w_end_;
  PixelBox box_{};
  int count_ = 0;
};

/// What of an object's mask is fitted: not the pixels on its outline, which may be mixed with what
/// is behind it, as far as the object affords to lose them. Of a thing of few pixels, or a thin
/// one, they are most of what tells its pose.
/// @param border_px So wide at most; less where more than an eighth of the mask would be lost.
template <class Mask>
[[nodiscard]] ErodedMask<Mask> InteriorOf(const Mask& mask, int border_px) noexcept {
  constexpr int kParts = 8;
  for (int radius_px = border_px; radius_px > 0; --radius_px) {
    const ErodedMask interior(mask, radius_px);
    if (kParts * interior.count() >= (kParts - 1) * mask.count()) return interior;
  }
  return ErodedMask(mask, 0);
}

}  // namespace disflow
