// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "disflow/depth/depth_reader.h"
#include "disflow/depth/pixel_mask.h"

namespace disflow {

/// Horizontal run of pixels on one continuous surface.
struct PixelRun {
  std::int16_t v = 0;
  std::int16_t u_begin = 0;
  std::int16_t u_end = 0;
  std::int32_t parent = 0;  ///< Union-find link; a root links to itself.
  std::int32_t pixels = 0;  ///< Of the whole component, valid at its root.
  std::int32_t votes = 0;   ///< See Vote(), valid at the root.
};

/// Connected components of a depth image over depth continuity, by union-find on horizontal runs.
/// One pass over the image, memory for kMaxRuns runs; rows that no longer fit are left out and
/// counted.
template <int kMaxRuns>
class PixelRuns {
 public:
  /// @param accept accept(u, v, depth_m): whether the pixel may belong to the object at all.
  template <class Accept>
  void Build(const DepthReader& depth, const PixelBox& box, float jump_ratio,
             Accept&& accept) noexcept {
    count_ = 0;
    dropped_ = 0;
    int above_begin = 0;
    int above_end = 0;
    for (int v = box.v_min; v < box.v_max; ++v) {
      const int row_begin = count_;
      BuildRow(depth, box, v, jump_ratio, accept);
      ConnectRows(depth, jump_ratio, above_begin, above_end, row_begin, count_);
      above_begin = row_begin;
      above_end = count_;
    }
    CountPixels();
  }

  [[nodiscard]] int dropped() const noexcept { return dropped_; }

  /// Root of the component that covers a pixel, or -1.
  [[nodiscard]] int ComponentAt(int u, int v) noexcept {
    for (int i = 0; i < count_; ++i) {
      const PixelRun& r = run(i);
      if (r.v == v && r.u_begin <= u && u < r.u_end) return Root(i);
    }
    return -1;
  }

  /// visit(root, first run of the component, pixels)
  template <class Visitor>
  void ForEachComponent(Visitor&& visit) noexcept {
    for (int i = 0; i < count_; ++i) {
      if (run(i).parent == i) visit(i, run(i), run(i).pixels);
    }
  }

  /// Counts, per component, the pixels of those runs that vote for it.
  template <class Judge>
  void Vote(Judge&& judge) noexcept {
    for (int i = 0; i < count_; ++i) {
      if (judge(run(i))) run(Root(i)).votes += run(i).u_end - run(i).u_begin;
    }
  }

  /// visit(root of the run's component, its first run with the component's totals, run)
  template <class Visitor>
  void ForEachRun(Visitor&& visit) noexcept {
    for (int i = 0; i < count_; ++i) {
      const int root = Root(i);
      visit(root, run(root), run(i));
    }
  }

 private:
  // Sensors lose single pixels; a run goes on across such gaps so that holes do not count as the
  // object's outline.
  static constexpr int kBridgedGapPx = 3;

  [[nodiscard]] PixelRun& run(int i) noexcept { return runs_[static_cast<std::size_t>(i)]; }

  [[nodiscard]] static bool Continuous(float a_m, float b_m, float jump_ratio) noexcept {
    return std::abs(a_m - b_m) <= jump_ratio * std::min(a_m, b_m);
  }

  template <class Accept>
  void BuildRow(const DepthReader& depth, const PixelBox& box, int v, float jump_ratio,
                Accept& accept) noexcept {
    int begin = -1;
    int last_valid = -1;
    float last_depth_m = 0.0F;
    for (int u = box.u_min; u < box.u_max; ++u) {
      const float depth_m = depth.At(u, v);
      if (depth_m <= 0.0F || !accept(u, v, depth_m)) continue;
      const bool joins = begin >= 0 && u - last_valid <= kBridgedGapPx + 1 &&
                         Continuous(depth_m, last_depth_m, jump_ratio);
      if (!joins) {
        if (begin >= 0) Append(v, begin, last_valid + 1);
        begin = u;
      }
      last_valid = u;
      last_depth_m = depth_m;
    }
    if (begin >= 0) Append(v, begin, last_valid + 1);
  }

  void Append(int v, int u_begin, int u_end) noexcept {
    if (count_ == kMaxRuns) {
      ++dropped_;
      return;
    }
    run(count_) = {static_cast<std::int16_t>(v), static_cast<std::int16_t>(u_begin),
                   static_cast<std::int16_t>(u_end), count_, 0};
    ++count_;
  }

  void ConnectRows(const DepthReader& depth, float jump_ratio, int a, int a_end, int b,
                   int b_end) noexcept {
    while (a < a_end && b < b_end) {
      const int u_begin = std::max(run(a).u_begin, run(b).u_begin);
      const int u_end = std::min(run(a).u_end, run(b).u_end);
      if (u_begin < u_end && Touch(depth, jump_ratio, run(b).v, u_begin, u_end)) Join(a, b);
      if (run(a).u_end < run(b).u_end) {
        ++a;
      } else {
        ++b;
      }
    }
  }

  [[nodiscard]] static bool Touch(const DepthReader& depth, float jump_ratio, int v, int u_begin,
                                  int u_end) noexcept {
    for (int u = u_begin; u < u_end; ++u) {
      const float above_m = depth.At(u, v - 1);
      const float below_m = depth.At(u, v);
      if (above_m > 0.0F && below_m > 0.0F && Continuous(above_m, below_m, jump_ratio)) return true;
    }
    return false;
  }

  [[nodiscard]] int Root(int i) noexcept {
    while (run(i).parent != i) {
      run(i).parent = run(run(i).parent).parent;  // path halving keeps later look-ups short
      i = run(i).parent;
    }
    return i;
  }

  void Join(int a, int b) noexcept {
    const int root_a = Root(a);
    const int root_b = Root(b);
    run(std::max(root_a, root_b)).parent = std::min(root_a, root_b);
  }

  void CountPixels() noexcept {
    for (int i = 0; i < count_; ++i) run(Root(i)).pixels += run(i).u_end - run(i).u_begin;
  }

  std::array<PixelRun, static_cast<std::size_t>(kMaxRuns)> runs_;
  int count_ = 0;
  int dropped_ = 0;
};

}  // namespace disflow
