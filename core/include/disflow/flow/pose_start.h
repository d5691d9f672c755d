// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/flow/expected_turn.h"
#include "disflow/flow/registration_result.h"
#include "disflow/geometry/transform.h"

/// @file
/// What the search for a pose works with and gives, whatever the profile; see pose_search.h.

namespace disflow {

/// Where the registration of the frame begins.
struct PoseSearchStart {
  PoseObjectFromCamera T_oc;
  PoseObjectFromCamera T_expected;  ///< What the motion so far says, as far as it is believed.
  RobustScale robust_scale;         ///< How far off it may be.
  int tried = 1;
  bool held = false;  ///< A prediction that explains the frame, of what something holds in place.
};

/// What is known before a frame is registered.
struct PoseSearchPrior {
  PoseObjectFromCamera T_predicted;  ///< By constant velocity.
  PoseObjectFromCamera T_previous;   ///< Of the last registered frame.
  /// false: the object was just started, the prediction is a guess.
  bool velocity_known = false;
  /// 0: the object was registered in the last frame. Else it has to be searched for, for the
  /// n-th frame in a row.
  int search = 0;
  /// Not negative: the object may have been turned anyhow meanwhile, and this is the n-th part of a
  /// search for it wherever it is, from 0.
  int global = -1;
  /// What was searched for, `global`, may be where it is predicted, or turned over: many things
  /// look nearly alike then, and boxes do.
  bool turned_over = false;
  /// By what is known of the motion of an object that is searched for.
  ExpectedTurn expected_turn = {};
  /// The last pose was followed, but may have slid: the image contradicted it.
  bool contradicted = false;
  /// The same, but nothing held it in its place along a direction.
  bool unheld = false;
};

/// The axes and the diagonals of a cube, both ways.
inline constexpr int kCubeDirections = 14;
/// @param index From 0 to kCubeDirections - 1.
[[nodiscard]] Vec3 CubeDirection(int index) noexcept;

/// The principal axes of a spread of points, as columns.
[[nodiscard]] Mat3 PrincipalAxes(const Mat3& covariance) noexcept;

/// The axis along which something is spread farthest, and its variance there.
struct LongestAxis {
  Vec3 direction;
  float variance = 0.0F;

  explicit LongestAxis(const Mat3& covariance) noexcept;
};

/// The pose of an object that has been turned over.
/// @param axis Unit vector through `center_m`, object frame.
[[nodiscard]] PoseObjectFromCamera TurnedOver(const PoseObjectFromCamera& T_oc, const Vec3& axis,
                                              const Vec3& center_m) noexcept;

/// The pose in the middle between two, turned about a centre.
/// @param center_c Camera frame.
[[nodiscard]] PoseObjectFromCamera HalfWay(const Vec3& center_c, const PoseObjectFromCamera& a,
                                           const PoseObjectFromCamera& b) noexcept;

/// How far apart two poses are, in units of what an impulse between two frames can do, squared.
struct ImpulsesApart {
  float shift2 = 0.0F;
  float turn2 = 0.0F;

  /// @param center_c The point whose shift counts, camera frame.
  ImpulsesApart(const Vec3& center_c, const PoseObjectFromCamera& T_oc,
                const PoseObjectFromCamera& T_predicted) noexcept;
};

}  // namespace disflow
