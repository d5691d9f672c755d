// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "disflow/geometry/transform.h"
#include "disflow/hal/pose_run.h"
#include "disflow/status.h"
#include "disflow/types.h"

namespace disflow::hal {

/// Poses of the body that carries the camera, as they come in, and the camera's pose at any moment
/// between them. Fixed memory; old poses make room for new ones.
///
/// Poses are believed in the order of their stamps. One that does not go on where the others ended
/// is held back: it is refused if the next ones go on as before (a wrong stamp, a late message),
/// and takes the place of what it contradicts if they go on from it (the wrong stamps were the
/// others, or the sender's clock has been set). A wrong stamp thus costs its own pose, no others.
class CameraPoseHistory {
 public:
  static constexpr std::size_t kCapacity = 256;
  /// The least time that a full history goes back, however fast the poses come.
  static constexpr std::int64_t kMinSpan_ns = PoseRun<kCapacity>::kMinSpan_ns;

  struct Settings {
    Transform<Body, Camera> T_bc;  ///< Where the camera sits on the body.
    /// Poses farther apart than this are not interpolated between.
    std::int64_t max_gap_ns = 250'000'000;
    /// How far beyond the newest pose the motion may be extrapolated.
    std::int64_t max_ahead_ns = 60'000'000;
    /// Stamps farther than this from now, back or ahead, are wrong.
    std::int64_t max_age_ns = 10'000'000'000;
    std::int64_t max_lead_ns = 10'000'000'000;
  };

  /// What came in and what was asked for; saturating.
  struct Counters {
    std::uint32_t poses = 0;        ///< Taken.
    std::uint32_t refused = 0;      ///< Not finite, no rotation, or one of the next.
    std::uint32_t wrong_stamp = 0;  ///< Far from now, not newer, or contradicted by the next ones.
    std::uint32_t jumps = 0;        ///< The sender's reset counter changed: the past was forgotten.
    std::uint32_t matched = 0;      ///< Stamps for which a pose was found.
    std::uint32_t continued = 0;    ///< Of these, extrapolated beyond the newest pose.
    std::uint32_t unmatched = 0;    ///< Stamps for which there was none.
  };

  explicit CameraPoseHistory(const Settings& settings) noexcept : settings_(settings) {}

  /// @param reset_counter Bumped by the sender when its world or its pose has jumped.
  /// @param now_ns Now, on the clock of the stamps.
  /// @return kOk (taken, or newer and held back until the next one bears it out),
  /// kInvalidTransform, kStampNotIncreasing (refused for its stamp, or older and held back).
  Status Add(StampNs stamp_ns, const Transform<World, Body, double>& T_wb,
             std::uint8_t reset_counter, std::int64_t now_ns) noexcept;

  /// Counts a pose whose stamp means nothing on the clock of the others.
  void RefuseStamp(std::size_t poses = 1) noexcept;

  /// The camera's pose, on the screw motion between the two neighbouring poses.
  /// @return kOk, or kNotFound if the stamp lies before the oldest, in a gap, or too far beyond the
  /// newest (`T_wc` is unchanged then).
  [[nodiscard]] Status At(StampNs stamp_ns, Transform<World, Camera>& T_wc) noexcept;

  [[nodiscard]] const Counters& counters() const noexcept { return counters_; }

 private:
  static constexpr std::size_t kRivalCapacity = 32;

  [[nodiscard]] bool GoesOn(StampNs from_ns, StampNs stamp_ns) const noexcept;
  [[nodiscard]] bool RivalTakes(const StampedPose& pose) noexcept;
  [[nodiscard]] bool RivalWins() const noexcept;
  void ReplaceByRival() noexcept;
  void DropRival() noexcept;
  [[nodiscard]] bool Find(StampNs stamp_ns, Transform<World, Body, double>& T_wb) noexcept;

  Settings settings_;
  PoseRun<kCapacity> run_;
  PoseRun<kRivalCapacity> rival_;  ///< What is held back; goes on from pose to pose.
  std::size_t held_back_ = 0;      ///< Poses of the rival, those thinned out as well.
  bool rival_missed_ = false;      ///< The last pose held back did not go on from the rival.
  std::uint8_t reset_counter_ = 0;
  Counters counters_;
};

}  // namespace disflow::hal
