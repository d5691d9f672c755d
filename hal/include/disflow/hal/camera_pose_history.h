// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "disflow/geometry/transform.h"
#include "disflow/status.h"
#include "disflow/types.h"

namespace disflow::hal {

/// The body that carries the camera: a vehicle, a robot's flange.
struct Body {};

/// Poses of the body that carries the camera, as they come in, and the camera's pose at any moment
/// between them. Fixed memory; old poses make room for new ones.
class CameraPoseHistory {
 public:
  static constexpr std::size_t kCapacity = 256;

  struct Settings {
    Transform<Body, Camera> T_bc;  ///< Where the camera sits on the body.
    /// Poses farther apart than this are not interpolated between.
    std::int64_t max_gap_ns = 250'000'000;
    /// How far beyond the newest pose the motion may be extrapolated.
    std::int64_t max_ahead_ns = 60'000'000;
  };

  /// What came in and what was asked for; saturating.
  struct Counters {
    std::uint32_t poses = 0;      ///< Taken.
    std::uint32_t refused = 0;    ///< Not finite, no rotation, or not newer than the one before.
    std::uint32_t jumps = 0;      ///< The sender's reset counter changed: the past was forgotten.
    std::uint32_t matched = 0;    ///< Stamps for which a pose was found.
    std::uint32_t continued = 0;  ///< Of these, extrapolated beyond the newest pose.
    std::uint32_t unmatched = 0;  ///< Stamps for which there was none.
  };

  explicit CameraPoseHistory(const Settings& settings) noexcept : settings_(settings) {}

  /// @param reset_counter Bumped by the sender when its world or its pose has jumped.
  /// @return kOk, kInvalidTransform, kStampNotIncreasing.
  Status Add(StampNs stamp_ns, const Transform<World, Body, double>& T_wb,
             std::uint8_t reset_counter) noexcept;

  /// The camera's pose, on the screw motion between the two neighbouring poses.
  /// @return kOk, or kNotFound if the stamp lies before the oldest, in a gap, or too far beyond the
  /// newest (`T_wc` is unchanged then).
  [[nodiscard]] Status At(StampNs stamp_ns, Transform<World, Camera>& T_wc) noexcept;

  [[nodiscard]] const Counters& counters() const noexcept { return counters_; }

 private:
  struct Stamped {
    StampNs stamp_ns = 0;
    Transform<World, Body, double> T_wb;
  };

  [[nodiscard]] const Stamped& Newest(std::size_t back) const noexcept {
    return poses_[(next_ + kCapacity - 1 - back) % kCapacity];
  }
  [[nodiscard]] bool Find(StampNs stamp_ns, Transform<World, Body, double>& T_wb) noexcept;

  Settings settings_;
  std::array<Stamped, kCapacity> poses_{};
  std::size_t next_ = 0;
  std::size_t size_ = 0;
  std::uint8_t reset_counter_ = 0;
  Counters counters_;
};

}  // namespace disflow::hal
