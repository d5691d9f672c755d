// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "disflow/depth/whole_windows.h"

/// @file
/// The part of WholeWindows that works on four windows at once; apart, since Eigen's expressions
/// cost everybody's compiler who includes tracker.h.

namespace disflow {

inline MomentsOf<WholeWindows::Lanes> WholeWindows::Columns::Read(int i) const noexcept {
  MomentsOf<Lanes> moments;
  ForEachPair(moments, of, [i](Lanes& lanes, const Row& row) {
    lanes = Eigen::Map<const Lanes>(row.data() + i);
  });
  return moments;
}

inline void WholeWindows::Columns::Write(int i, const MomentsOf<Lanes>& moments) noexcept {
  ForEachPair(of, moments,
              [i](Row& row, const Lanes& lanes) { Eigen::Map<Lanes>(row.data() + i) = lanes; });
}

inline void WholeWindows::MergeLanes(int i, float step_px) noexcept {
  MomentsOf<Lanes> sum = blocks_[1].Read(i + 1);
  const Lanes reference = sum.w_reference;
  Lanes fewest = sum.n;
  std::array<Lanes, 3> bends;
  for (Lanes& bend : bends) bend.setZero();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      const MomentsOf<Lanes> other = blocks_[Side(r)].Read(i + c);
      const auto x = static_cast<float>(c - 1);
      const auto y = static_cast<float>(r - 1);
      if (c != 1 || r != 1) sum.Add(other, step_px * x, step_px * y);
      fewest = fewest.min(other.n);
      const Lanes mean = other.w_reference - reference + other.w / other.n;
      bends[0] += (x * x - 2.0F / 3.0F) * mean;
      bends[1] += (y * y - 2.0F / 3.0F) * mean;
      bends[2] += x * y * mean;
    }
  }
  sums_.Write(i, sum);
  Eigen::Map<Lanes>(fewest_.data() + i) = fewest;
  for (std::size_t k = 0; k < bends.size(); ++k) Eigen::Map<Lanes>(bends_[k].data() + i) = bends[k];
}

}  // namespace disflow
