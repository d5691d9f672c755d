// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/depth/depth_frame.h"
#include "disflow/estimate.h"
#include "disflow/geometry/transform.h"
#include "icp_settings.h"
#include "voxel_model.h"

namespace disflow::bench {

/// Tracks an object as the tracker does, by ICP of PCL: every frame is registered to all that was
/// seen before, from where constant velocity leads, and added to it. Velocities are differences of
/// two successive poses.
class IcpTracker {
 public:
  explicit IcpTracker(const IcpSettings& settings)
      : settings_(settings), model_(settings.voxel_m) {}

  /// @param estimate Its covariances stay zero: ICP states none. Not ok and lost: the pose is
  /// predicted.
  void Process(const DepthFrame& frame, Estimate& estimate);

 private:
  using Pose = Transform<Object, Camera, double>;  ///< T_oc

  [[nodiscard]] Status Register(const Cloud& cloud_c, StampNs stamp_ns);
  void Start(const Cloud& cloud_c);
  [[nodiscard]] Pose Predict(StampNs stamp_ns) const;
  [[nodiscard]] Twist TwistBetween() const;

  IcpSettings settings_;
  VoxelModel model_;
  bool started_ = false;
  StampNs stamp_ns_ = 0;
  StampNs previous_ns_ = 0;
  Pose T_oc_;
  Pose T_oc_previous_;
};

}  // namespace disflow::bench
