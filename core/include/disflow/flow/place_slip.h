// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/types.h"

namespace disflow {

/// Along what an object whose place was lost is looked for.
struct FreeShift {
  Vec3 direction = Vec3::UnitX();  ///< Object frame.
  float step_m = 0.0F;
  int part = 0;  ///< The n-th part of the search, from 0.

  /// The i-th place of the part, from where the object was registered: by turns to either side,
  /// farther in later parts.
  /// @param places How many a part has.
  [[nodiscard]] Vec3 Place(int i, int places) const noexcept;
};

/// How far an object may have slid while nothing held it in its place: a long box whose ends are
/// out of the image, a face without outlines. What comes into view then is built into the model at
/// a place that may be wrong, and holds the pose there. So the uncertainty stays until what was
/// known before holds it again.
class PlaceSlip {
 public:
  void Start(StampNs stamp_ns) noexcept;

  /// Takes in a followed frame.
  /// @param unheld Nothing holds the place along some direction.
  /// @param free_o Covariance (origin's position, rotation) of how far it may slide along what this
  /// frame says of that direction in a second, object axes.
  /// @param slid_s For how long nothing has held it.
  /// @param by_known What was known before holds it.
  void Learn(StampNs stamp_ns, bool unheld, const Mat6& free_o, float slid_s,
             bool by_known) noexcept;
  /// The object was found elsewhere, which frames that follow have to confirm; if it is not held
  /// there it is looked for nearby first.
  void Found() noexcept { part_ = 0; }

  /// Whether the place may be wrong, so that what is found may belong elsewhere.
  [[nodiscard]] bool free() const noexcept { return free_; }
  /// Of how far it may have slid, object axes, with a slide that goes on in the present frame.
  /// A frame says the direction with its noise, and a slide of decimetres is known to tenths of
  /// millimetres across it: that of all of its frames counts, with how far they differ.
  /// @param free_o, slid_s As for Learn(); zero if something holds it.
  [[nodiscard]] Mat6 Covariance(const Mat6& free_o, float slid_s) const noexcept;

  /// Where to look next, as far as it may have slid.
  /// @param center_m Of the model, object frame.
  /// @param reach_m Half of its size.
  /// @param places How many are looked at in one frame.
  [[nodiscard]] FreeShift Next(const Vec3& center_m, float reach_m, float step_m,
                               int places) noexcept;

 private:
  void End() noexcept;

  bool free_ = false;
  StampNs held_ns_ = 0;               ///< When something last held it.
  Mat6 covariance_o_ = Mat6::Zero();  ///< Of the slides that have come to an end.
  Mat6 free_o_ = Mat6::Zero();        ///< Of the slide that goes on, the mean of its frames.
  int sliding_frames_ = 0;
  float slid_s_ = 0.0F;
  int known_frames_ = 0;  ///< In a row.
  int part_ = 0;
};

}  // namespace disflow
