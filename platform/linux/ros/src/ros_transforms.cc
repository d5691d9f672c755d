// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/ros/ros_transforms.h"

#include <algorithm>
#include <utility>

namespace disflow::posix {
namespace {

/// ROS 1 began names with a slash, and some still do.
/// @return Empty if it is none.
std::string FrameName(std::string_view name) {
  if (name.starts_with('/')) name.remove_prefix(1);
  // A thousand names of megabytes would take all memory.
  return name.size() > RosTransforms::kMaxName ? std::string() : std::string(name);
}

}  // namespace

RosTransforms::RosTransforms(std::string_view world, std::string_view camera)
    : world_(FrameName(world)), camera_(FrameName(camera)) {}

void RosTransforms::Add(const RosTransform& transform, bool fixed) {
  // Written so that NaN fails.
  const double norm = transform.rotation.norm();
  if (!(norm > 0.9 && norm < 1.1)) return;
  Link link{FrameName(transform.parent),
            {transform.rotation, transform.translation_m},
            transform.ros_ns,
            fixed};
  const std::string child = FrameName(transform.child);
  if (!link.T_parent_child.IsFinite() || child.empty() || link.parent.empty()) return;
  if (links_.size() >= kMaxFrames && !links_.contains(child)) return;
  links_[child] = std::move(link);
}

std::optional<RosTransforms::CameraPose> RosTransforms::Camera() {
  CameraPose pose;
  bool moves = false;
  const std::string* frame = &camera_;
  // Bounded, for others may have tied a knot into the tree.
  for (int depth = 0; depth < kMaxDepth && *frame != world_; ++depth) {
    const auto found = links_.find(*frame);
    if (found == links_.end()) return std::nullopt;
    Link& link = found->second;
    const auto& above = link.T_parent_child;
    pose.T_wc = {Mat<double, 3, 3>(above.rotation() * pose.T_wc.rotation()),
                 Mat<double, 3>(above.rotation() * pose.T_wc.translation() + above.translation())};
    if (!link.fixed && std::exchange(link.has_come, false)) {
      pose.ros_ns = moves ? std::max(pose.ros_ns, link.ros_ns) : link.ros_ns;
      moves = true;
    }
    frame = &link.parent;
  }
  if (*frame != world_ || !moves) return std::nullopt;
  return pose;
}

}  // namespace disflow::posix
