// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_transforms.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace disflow::apps {
namespace {

/// ROS 1 began names with a slash, and some still do.
/// @return Empty if it is none.
std::string FrameName(const char* text) {
  std::string_view name = posix::TextOf(text);
  if (name.starts_with('/')) name.remove_prefix(1);
  // A thousand names of megabytes would take all memory.
  return name.size() > DdsTransforms::kMaxName ? std::string() : std::string(name);
}

}  // namespace

void DdsTransforms::Add(const posix::ros::TransformStamped& message, bool fixed) {
  const auto& [translation, rotation] = message.transform;
  const Eigen::Quaternion<double, Eigen::DontAlign> q(rotation.w, rotation.x, rotation.y,
                                                      rotation.z);
  // Written so that NaN fails.
  const double norm = q.norm();
  if (!(norm > 0.9 && norm < 1.1)) return;
  Link link{FrameName(message.header.frame_id),
            {q, Mat<double, 3>(translation.x, translation.y, translation.z)},
            posix::RosNanoseconds(message.header.stamp),
            fixed};
  const std::string child = FrameName(message.child_frame_id);
  if (!link.T_parent_child.IsFinite() || child.empty() || link.parent.empty()) return;
  if (links_.size() >= kMaxFrames && !links_.contains(child)) return;
  links_[child] = std::move(link);
}

std::optional<DdsTransforms::CameraPose> DdsTransforms::Camera() {
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

}  // namespace disflow::apps
