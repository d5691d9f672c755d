// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/host/rigid_state.h"
#include "disflow/host/triangle_mesh.h"

namespace disflow::host {

/// A forearm that comes from below, passes in front of the object again and again and hides up to
/// half of it. The first frame is free of it.
class OccludingArm {
 public:
  OccludingArm(double object_radius_m, std::uint64_t seed);

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  /// @param T_co The object, which the arm follows.
  [[nodiscard]] Transform<Camera, Object, double> PoseAt(
      double time_s, const Transform<Camera, Object, double>& T_co) const;

 private:
  double object_radius_m_;
  double radius_m_;
  double sweep_rps_;
  double lean_rad_;
  TriangleMesh mesh_;
};

}  // namespace disflow::host
