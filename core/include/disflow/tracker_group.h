// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "disflow/tracker.h"

namespace disflow {

/// How one of several objects is told from the others: by the value of its pixels in the mask, or,
/// without a mask, by a seed or a region of its own (SegmenterConfig).
struct GroupedObject {
  Config config;
  std::uint8_t mask_label = 0;  ///< 0: masks are left aside for this object.
};

/// Several objects at once, a tracker each, in fixed memory: kCount x sizeof(Tracker<Limits>).
/// The trackers share nothing but the frame, so none disturbs another, and what one gives does not
/// depend on the others. Whoever has several cores calls ProcessOne() for different objects from
/// different threads; the results are the same.
template <CapacityProfile Limits, int kCount>
class TrackerGroup {
 public:
  static_assert(kCount > 0);
  static constexpr std::size_t kSize = static_cast<std::size_t>(kCount);
  using Objects = std::array<GroupedObject, kSize>;
  using Estimates = std::array<Estimate, kSize>;

  explicit TrackerGroup(const Objects& objects) noexcept
      : TrackerGroup(objects, std::make_index_sequence<kSize>{}) {}

  /// Tracks all objects in one frame, one after another.
  /// @param estimates Always written completely; each has its own status.
  void Process(const DepthFrame& frame, Estimates& estimates, StageClock clock = {}) noexcept {
    for (std::size_t i = 0; i < kSize; ++i) (void)ProcessOne(i, frame, estimates[i], clock);
  }

  /// Tracks one of the objects. See Tracker::Process().
  Status ProcessOne(std::size_t index, const DepthFrame& frame, Estimate& estimate,
                    StageClock clock = {}) noexcept {
    return trackers_[index].Process(FrameOf(frame, labels_[index]), estimate, clock);
  }

  [[nodiscard]] Tracker<Limits>& operator[](std::size_t index) noexcept { return trackers_[index]; }
  [[nodiscard]] const Tracker<Limits>& operator[](std::size_t index) const noexcept {
    return trackers_[index];
  }

  /// The frame as the object of a label is to see it.
  [[nodiscard]] static DepthFrame FrameOf(const DepthFrame& frame, std::uint8_t label) noexcept {
    DepthFrame own = frame;
    if (label == 0) own.mask = {};
    own.mask.label = label;
    return own;
  }

 private:
  template <std::size_t... kIndex>
  TrackerGroup(const Objects& objects, std::index_sequence<kIndex...> /*indices*/) noexcept
      : trackers_{{Tracker<Limits>(objects[kIndex].config)...}},
        labels_{{objects[kIndex].mask_label...}} {}

  std::array<Tracker<Limits>, kSize> trackers_;
  std::array<std::uint8_t, kSize> labels_;
};

}  // namespace disflow
