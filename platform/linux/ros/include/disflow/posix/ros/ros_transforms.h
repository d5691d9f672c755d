// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "disflow/geometry/transform.h"
#include "disflow/hal/pose_run.h"

namespace disflow::posix {

/// What a geometry_msgs/TransformStamped says, however it came; nothing of it is trusted.
struct RosTransform {
  std::string_view parent;
  std::string_view child;
  Eigen::Quaternion<double, Eigen::DontAlign> rotation{1.0, 0.0, 0.0, 0.0};
  Mat<double, 3> translation_m = Mat<double, 3>::Zero();
  std::int64_t ros_ns = 0;
};

/// As much of ROS's tf tree as leads from the world to the camera.
class RosTransforms {
 public:
  static constexpr std::size_t kMaxFrames = 1024;  ///< Of the tree; those beyond are left out.
  static constexpr int kMaxDepth = 64;
  static constexpr std::size_t kMaxName = 255;  ///< A longer one is no frame's.

  using Pose = Transform<World, hal::Body, double>;

  /// Where the camera is.
  struct CameraPose {
    std::int64_t ros_ns = 0;  ///< Of the newest of the moving links that have come.
    Pose T_wc;
  };

  /// @param world,camera Names of frames.
  RosTransforms(std::string_view world, std::string_view camera);

  /// @param fixed From /tf_static. What is no transform is left out.
  void Add(const RosTransform& transform, bool fixed);
  /// @return Nothing if the world does not lead to the camera, or if none of the moving links
  /// between them has come since the last call.
  [[nodiscard]] std::optional<CameraPose> Camera();

 private:
  struct Link {
    std::string parent;
    Pose T_parent_child;
    std::int64_t ros_ns = 0;
    bool fixed = false;
    bool has_come = true;  ///< Since Camera() was called last.
  };

  std::string world_;
  std::string camera_;
  std::map<std::string, Link> links_;  ///< By the child's name.
};

}  // namespace disflow::posix
