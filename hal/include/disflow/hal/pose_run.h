// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "disflow/geometry/transform.h"
#include "disflow/types.h"

namespace disflow::hal {

/// The body that carries the camera: a vehicle, a robot's flange.
struct Body {};

/// How far `later` lies after `earlier`, of any two stamps; 0 if it does not.
constexpr std::uint64_t SpanNs(StampNs earlier, StampNs later) noexcept {
  // Stamps of a damaged sender may be anything: the difference of two may not fit a signed number.
  return later > earlier ? static_cast<std::uint64_t>(later) - static_cast<std::uint64_t>(earlier)
                         : 0;
}

/// Where the body was, and when.
struct StampedPose {
  StampNs stamp_ns = 0;
  Transform<World, Body, double> T_wb;
};

/// Poses of increasing stamps in fixed memory; the oldest make way. Poses that come faster than
/// every kMinStep_ns are thinned out, all but the newest, so that a run that is full spans at least
/// kMinSpan_ns however fast they come.
template <std::size_t kCapacity>
class PoseRun {
 public:
  static constexpr std::int64_t kMinStep_ns = 4'000'000;
  /// The step to the newest may be any.
  static constexpr std::int64_t kMinSpan_ns =
      static_cast<std::int64_t>(kCapacity - 2) * kMinStep_ns;

  /// @param pose Newer than Newest().
  void Push(const StampedPose& pose) noexcept {
    constexpr auto kMinStep = static_cast<std::uint64_t>(kMinStep_ns);
    if (size_ >= 2 && SpanNs(Newest(1).stamp_ns, Newest(0).stamp_ns) < kMinStep) PopNewest();
    poses_[next_] = pose;
    next_ = (next_ + 1) % kCapacity;
    if (size_ < kCapacity) ++size_;
  }
  void PopNewest() noexcept {
    next_ = (next_ + kCapacity - 1) % kCapacity;
    --size_;
  }
  void Clear() noexcept { size_ = 0; }

  /// @param back Less than size().
  [[nodiscard]] const StampedPose& Newest(std::size_t back = 0) const noexcept {
    return poses_[(next_ + kCapacity - 1 - back) % kCapacity];
  }
  [[nodiscard]] const StampedPose& Oldest() const noexcept { return Newest(size_ - 1); }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] bool full() const noexcept { return size_ == kCapacity; }

  /// @return How many poses are not older than `stamp_ns`.
  [[nodiscard]] std::size_t CountFrom(StampNs stamp_ns) const noexcept {
    std::size_t count = 0;
    while (count < size_ && Newest(count).stamp_ns >= stamp_ns) ++count;
    return count;
  }

 private:
  std::array<StampedPose, kCapacity> poses_{};
  std::size_t next_ = 0;
  std::size_t size_ = 0;
};

}  // namespace disflow::hal
