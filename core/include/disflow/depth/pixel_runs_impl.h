// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "disflow/depth/pixel_runs.h"

/// @file
/// Definitions of PixelRuns' members that connect runs and look at all of them; apart, so that
/// tracker.h stays light.

namespace disflow {

template <int kMaxRuns, int kMaxWidth>
void PixelRuns<kMaxRuns, kMaxWidth>::ConnectRows(int u_origin, float jump_ratio, int a, int a_end,
                                                 int b, int b_end) noexcept {
  while (a < a_end && b < b_end) {
    const int begin = std::max(run(a).u_begin, run(b).u_begin) - u_origin;
    const int end = std::min(run(a).u_end, run(b).u_end) - u_origin;
    if (begin < end && Touch(jump_ratio, begin, end)) Join(a, b);
    if (run(a).u_end < run(b).u_end) {
      ++a;
    } else {
      ++b;
    }
  }
}

template <int kMaxRuns, int kMaxWidth>
bool PixelRuns<kMaxRuns, kMaxWidth>::Touch(float jump_ratio, int begin, int end) const noexcept {
  for (int i = begin; i < end; ++i) {
    const float above_m = rows_m_[1 - current_][static_cast<std::size_t>(i)];
    const float below_m = rows_m_[current_][static_cast<std::size_t>(i)];
    if (above_m > 0.0F && below_m > 0.0F && Continuous(above_m, below_m, jump_ratio)) return true;
  }
  return false;
}

/// Noise makes thousands of runs: crumbs that are too small to be remembered, and surfaces that it
/// cuts again and again in each row though they hang together around the cut. However many there
/// are, each is visited at most twice for it, and all of them as often as gaps can be doubled.
template <int kMaxRuns, int kMaxWidth>
void PixelRuns<kMaxRuns, kMaxWidth>::MakeRoom() noexcept {
  const bool was_in_vain = 2 * (count_ - least_count_) < kMaxRuns;
  if (was_in_vain) return;
  for (;; merged_gap_px_ *= 2) {
    Flatten();
    // What has a run in the last row may grow.
    for (int i = above_begin_; i < count_; ++i) run(run(i).parent).pixels = kNoComponent;
    Renumber();
    Compact();
    if (2 * count_ <= kMaxRuns || merged_gap_px_ >= kLargestGapPx) break;
  }
  least_count_ = count_;
}

/// Closes the gaps that Renumber() has left.
template <int kMaxRuns, int kMaxWidth>
void PixelRuns<kMaxRuns, kMaxWidth>::Compact() noexcept {
  int kept = 0;
  for (int i = 0; i < count_; ++i) {
    if (run(i).parent == kNoComponent) continue;
    run(kept) = run(i);
    run(kept).pixels = 0;
    ++kept;
  }
  // Of the last two rows all are there still.
  above_begin_ -= count_ - kept;
  row_begin_ -= count_ - kept;
  count_ = kept;
}

/// Gives every run's parent the number that it will have once those that are given up, which get
/// kNoComponent for a parent, are gone. Of a component, the root comes first.
template <int kMaxRuns, int kMaxWidth>
void PixelRuns<kMaxRuns, kMaxWidth>::Renumber() noexcept {
  int kept = 0;
  int last = 0;              // Run that was kept last,
  int last_root = kMaxRuns;  // and its component.
  for (int i = 0; i < count_; ++i) {
    PixelRun& r = run(i);
    const int root = r.parent;
    if (root == i) {
      const bool is_crumb = r.pixels < fewest_pixels_;
      r.pixels = static_cast<std::uint16_t>(is_crumb ? kNoComponent : kept);
    }
    r.parent = run(root).pixels;
    if (r.parent == kNoComponent) continue;
    const bool goes_on = i < above_begin_ && root == last_root && r.v == run(last).v &&
                         r.u_begin - run(last).u_end <= merged_gap_px_;
    if (goes_on) {
      run(last).u_end = r.u_end;
      r.parent = static_cast<std::uint16_t>(kNoComponent);
      continue;
    }
    ++kept;
    last = i;
    last_root = root;
  }
}

/// Links every run to its root and counts pixels there. A parent comes before its children.
template <int kMaxRuns, int kMaxWidth>
void PixelRuns<kMaxRuns, kMaxWidth>::Flatten() noexcept {
  for (int i = 0; i < count_; ++i) {
    PixelRun& r = run(i);
    r.parent = run(r.parent).parent;
    PixelRun& root = run(r.parent);
    root.pixels = static_cast<std::uint16_t>(std::min(65535, root.pixels + r.length()));
  }
}

template <int kMaxRuns, int kMaxWidth>
void PixelRuns<kMaxRuns, kMaxWidth>::RememberLargest() noexcept {
  for (int i = 0; i < count_; ++i) {
    const PixelRun& r = run(i);
    if (r.parent != i || r.pixels < fewest_pixels_) continue;
    if (!components_.full()) {
      (void)components_.push_back({i, r.pixels});
      continue;
    }
    auto* smallest = std::min_element(
        components_.begin(), components_.end(),
        [](const Component& a, const Component& b) { return a.pixels < b.pixels; });
    if (smallest->pixels < r.pixels) *smallest = {i, r.pixels};
  }
  for (int i = 0; i < count_; ++i) {
    if (run(i).parent == i) run(i).pixels = static_cast<std::uint16_t>(kNoComponent);
  }
  for (int c = 0; c < components_.size(); ++c) {
    run(components_[c].first_run).pixels = static_cast<std::uint16_t>(c);
    components_[c].pixels = 0;
  }
  // Once more, without saturation.
  ForEachRun([this](int c, const PixelRun& r) {
    if (c != kNoComponent) components_[c].pixels += r.length();
  });
}

}  // namespace disflow
