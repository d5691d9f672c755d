// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "disflow/depth/depth_reader.h"
#include "disflow/depth/pixel_mask.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// Horizontal run of pixels on one continuous surface.
struct PixelRun {
  // No initial values: thousands of runs lie in memory that is new in every frame.
  std::int16_t v;
  std::int16_t u_begin;
  std::int16_t u_end;
  std::uint16_t parent;  ///< Union-find link; a root links to itself.
  std::uint16_t pixels;  ///< At a root: of the component, saturating; then its number.

  [[nodiscard]] int length() const noexcept { return u_end - u_begin; }
};

/// Connected components of a depth image over depth continuity, by union-find on horizontal runs.
/// One pass over the image, memory for kMaxRuns runs and two image rows. When it is full, crumbs
/// that nothing can be added to any more are given up, and what noise has cut into many runs
/// becomes one; what does not fit then is left out and counted. The kMaxComponents largest
/// components are remembered.
template <int kMaxRuns, int kMaxWidth>
class PixelRuns {
  static_assert(kMaxRuns <= 65535);

 public:
  static constexpr int kMaxComponents = 64;
  static constexpr int kNoComponent = 65535;

  struct Component {
    int first_run = 0;  ///< Topmost, leftmost run.
    int pixels = 0;
  };

  /// @param gate gate(v, u_begin, u_end, depth_m): sets to 0 the depths of a row's pixels that
  /// cannot belong to the object.
  /// @param fewest_pixels Smaller components are not remembered.
  /// @param bridged_px Gaps of so many pixels in a row are gone across.
  template <class Gate>
  void Build(const DepthReader& depth, const PixelBox& box, float jump_ratio, int fewest_pixels,
             Gate&& gate, int bridged_px) noexcept {
    count_ = 0;
    least_count_ = 0;
    merged_gap_px_ = kSmallestGapPx;
    above_begin_ = 0;
    row_begin_ = 0;
    fewest_pixels_ = fewest_pixels;
    bridged_px_ = bridged_px;
    dropped_ = 0;
    components_.clear();
    for (int v = box.v_min; v < box.v_max && !box.empty(); ++v) {
      current_ = 1 - current_;
      depth.ReadRow(v, box.u_min, box.u_max, row_m().data());
      gate(v, box.u_min, box.u_max, row_m().data());
      above_begin_ = row_begin_;
      row_begin_ = count_;
      BuildRow(box, v, jump_ratio);
      ConnectRows(box.u_min, jump_ratio, above_begin_, row_begin_, row_begin_, count_);
    }
    Flatten();
    RememberLargest();
  }

  [[nodiscard]] int dropped() const noexcept { return dropped_; }
  [[nodiscard]] int components() const noexcept { return components_.size(); }
  [[nodiscard]] const Component& component(int i) const noexcept { return components_[i]; }
  [[nodiscard]] const PixelRun& first_run(int component) const noexcept {
    return run(components_[component].first_run);
  }

  /// The remembered component that covers a pixel or comes nearest to it.
  /// @return kNoComponent if none comes as near as `reach_px`.
  [[nodiscard]] int ComponentAt(int u, int v, int reach_px = 0) const noexcept {
    int nearest = kNoComponent;
    int least_squared = reach_px * reach_px;
    for (int i = 0; i < count_; ++i) {
      const PixelRun& r = run(i);
      const int component = run(r.parent).pixels;
      const int du = std::max({0, int{r.u_begin} - u, u - (int{r.u_end} - 1)});
      const int dv = int{r.v} - v;
      const int squared = du * du + dv * dv;
      if (component == kNoComponent || squared > least_squared) continue;
      // Of runs as near as each other the first.
      if (squared == least_squared && nearest != kNoComponent) continue;
      least_squared = squared;
      nearest = component;
    }
    return nearest;
  }

  /// visit(number of the run's component or kNoComponent, run), row by row, from left to right.
  /// @param from_below The other way round.
  template <class Visitor>
  void ForEachRun(Visitor&& visit, bool from_below = false) const noexcept {
    for (int k = 0; k < count_; ++k) {
      const int i = from_below ? count_ - 1 - k : k;
      visit(static_cast<int>(run(run(i).parent).pixels), run(i));
    }
  }

 private:
  using Row = std::array<float, static_cast<std::size_t>(kMaxWidth)>;
  static constexpr int kPart_px = 32;  ///< Of a row, looked at together.
  /// Between runs of a surface that become one when memory is full, first and at last: what noise
  /// cuts out, crumbs and holes. Where another surface lies between them they stay two.
  static constexpr int kSmallestGapPx = 3;
  static constexpr int kLargestGapPx = 24;

  [[nodiscard]] Row& row_m() noexcept { return rows_m_[current_]; }
  [[nodiscard]] PixelRun& run(int i) noexcept { return runs_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const PixelRun& run(int i) const noexcept {
    return runs_[static_cast<std::size_t>(i)];
  }

  [[nodiscard]] static bool Continuous(float a_m, float b_m, float jump_ratio) noexcept {
    return std::abs(a_m - b_m) <= jump_ratio * std::min(a_m, b_m);
  }

  /// Where in a row something begins or ends: flags of pixels that do not go on with what is to
  /// their left. Most pixels do, and are looked at by vector instructions alone.
  void FlagChanges(int width, float jump_ratio) noexcept {
    const Row& depths_m = row_m();
    changes_[0] = depths_m[0] > 0.0F ? 1 : 0;
    for (int begin = 1; begin < width; begin += kPart_px) {
      const int end = std::min(begin + kPart_px, width);
      // Much of a row is nothing.
      if (end - begin == kPart_px && IsEmpty(depths_m.data() + begin - 1)) {
        std::fill_n(changes_.begin() + begin, kPart_px, std::uint8_t{0});
      } else {
        FlagChanges(begin, end, jump_ratio);
      }
    }
    const int end = (width + kFlagsAtOnce - 1) / kFlagsAtOnce * kFlagsAtOnce;
    std::fill(changes_.begin() + width, changes_.begin() + end, std::uint8_t{0});
  }

  /// Whether none of the pixels of a part and the one before it has depth.
  [[nodiscard]] static bool IsEmpty(const float* depths_m) noexcept {
    const Eigen::Map<const Eigen::Array<float, kPart_px, 1>> part_m(depths_m + 1);
    return depths_m[0] <= 0.0F && part_m.maxCoeff() <= 0.0F;
  }

  void FlagChanges(int begin, int end, float jump_ratio) noexcept {
    const Row& depths_m = row_m();
    for (int i = begin; i < end; ++i) {
      const float left_m = depths_m[static_cast<std::size_t>(i - 1)];
      const float here_m = depths_m[static_cast<std::size_t>(i)];
      const float nearer_m = left_m < here_m ? left_m : here_m;
      // Of two that are 0 there is no jump, of one of them there always is.
      const int jumps = int{std::abs(here_m - left_m) > jump_ratio * nearer_m};
      changes_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(jumps);
    }
  }

  /// visit(i) for the flagged pixels, from left to right.
  template <class Visitor>
  void ForEachChange(int width, Visitor&& visit) const noexcept {
    for (int i = 0; i < width; i += kFlagsAtOnce) {
      std::uint64_t any = 0;
      std::memcpy(&any, changes_.data() + i, sizeof any);
      if (any == 0) continue;
      for (int k = i; k < i + kFlagsAtOnce; ++k) {
        if (changes_[static_cast<std::size_t>(k)] != 0) visit(k);
      }
    }
  }

  void BuildRow(const PixelBox& box, int v, float jump_ratio) noexcept {
    const Row& depths_m = row_m();
    const auto depth_m = [&depths_m](int i) { return depths_m[static_cast<std::size_t>(i)]; };
    int begin = -1;
    int last_valid = -1;
    FlagChanges(box.width(), jump_ratio);
    ForEachChange(box.width(), [&](int i) {
      if (i > 0 && depth_m(i - 1) > 0.0F) last_valid = i - 1;
      if (depth_m(i) <= 0.0F) return;
      const bool joins = begin >= 0 && i - last_valid <= bridged_px_ + 1 &&
                         Continuous(depth_m(i), depth_m(last_valid), jump_ratio);
      if (joins) return;
      if (begin >= 0) Append(v, box.u_min + begin, box.u_min + last_valid + 1);
      begin = i;
    });
    if (depth_m(box.width() - 1) > 0.0F) last_valid = box.width() - 1;
    if (begin >= 0) Append(v, box.u_min + begin, box.u_min + last_valid + 1);
  }

  void Append(int v, int u_begin, int u_end) noexcept {
    if (count_ == kMaxRuns) MakeRoom();
    if (count_ == kMaxRuns) {
      ++dropped_;
      return;
    }
    run(count_) = {static_cast<std::int16_t>(v), static_cast<std::int16_t>(u_begin),
                   static_cast<std::int16_t>(u_end), static_cast<std::uint16_t>(count_), 0};
    ++count_;
  }

  void ConnectRows(int u_origin, float jump_ratio, int a, int a_end, int b, int b_end) noexcept;
  [[nodiscard]] bool Touch(float jump_ratio, int begin, int end) const noexcept;

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
    run(std::max(root_a, root_b)).parent = static_cast<std::uint16_t>(std::min(root_a, root_b));
  }

  void MakeRoom() noexcept;
  void Renumber() noexcept;
  void Compact() noexcept;
  void Flatten() noexcept;
  void RememberLargest() noexcept;

  std::array<PixelRun, static_cast<std::size_t>(kMaxRuns)> runs_;
  FixedVector<Component, kMaxComponents> components_;
  std::array<Row, 2> rows_m_;  ///< Depths of this row and of the one above.
  static constexpr int kFlagsAtOnce = 8;
  std::array<std::uint8_t, static_cast<std::size_t>(kMaxWidth + kFlagsAtOnce)> changes_;
  std::size_t current_ = 0;
  int count_ = 0;
  int least_count_ = 0;  ///< After room was made last.
  int merged_gap_px_ = kSmallestGapPx;
  int above_begin_ = 0;  ///< First run of the row above.
  int row_begin_ = 0;    ///< First run of the row that is being built.
  int dropped_ = 0;
  int fewest_pixels_ = 0;
  int bridged_px_ = 0;
};

}  // namespace disflow
