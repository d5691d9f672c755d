// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_motion.h"

#include <algorithm>

#include "disflow/geometry/covariance.h"

namespace disflow::apps {
namespace {

namespace ros = posix::ros;

template <class Out>
Out Make3(const Vec3& v) noexcept {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

template <class Quaternion>
ros::Quaternion MakeQuaternion(const Quaternion& q) noexcept {
  return {static_cast<double>(q.x()), static_cast<double>(q.y()), static_cast<double>(q.z()),
          static_cast<double>(q.w())};
}

template <class FrameA, class FrameB>
ros::Pose RosPose(const Transform<FrameA, FrameB>& T) noexcept {
  return {Make3<ros::Point>(T.translation()), MakeQuaternion(T.rotation_quaternion())};
}

template <class FrameA, class FrameB>
ros::TransformStamped RosTransform(const Transform<FrameA, FrameB>& T, std::int64_t ros_ns,
                                   const std::string& parent, const std::string& child) noexcept {
  ros::TransformStamped message{};
  message.header = RosHeader(ros_ns, parent);
  message.child_frame_id = posix::Lend(child);
  message.transform = {Make3<ros::Vector3>(T.translation()),
                       MakeQuaternion(T.rotation_quaternion())};
  return message;
}

/// Row by row; both sides have (x, y, z, about x, about y, about z). From the upper triangle, as
/// all outputs: rounding leaves the lower one a bit different, and some filters refuse that.
void Fill(const Mat6& covariance, double (&out)[36]) noexcept {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      out[6 * i + j] = static_cast<double>(covariance(std::min(i, j), std::max(i, j)));
    }
  }
}

}  // namespace

ros::Header RosHeader(std::int64_t ros_ns, const std::string& frame) noexcept {
  return {posix::RosTime(ros_ns), posix::Lend(frame)};
}

ros::Odometry MakeRosOdometry(const Estimate& estimate, std::int64_t ros_ns,
                              const DdsFrames& frames) noexcept {
  ros::Odometry message{};
  message.header = RosHeader(ros_ns, frames.camera);
  message.child_frame_id = posix::Lend(frames.object);
  message.pose.pose = RosPose(estimate.T_co);
  Fill(estimate.pose_covariance, message.pose.covariance);
  const Mat3 R_oc = estimate.T_co.rotation().transpose();
  message.twist.twist = {Make3<ros::Vector3>(R_oc * estimate.twist.linear_mps),
                         Make3<ros::Vector3>(R_oc * estimate.twist.angular_rps)};
  Fill(RotatedCovariance(estimate.twist_covariance, R_oc), message.twist.covariance);
  return message;
}

ros::PoseWithCovarianceStamped MakeRosPose(const Estimate& estimate, std::int64_t ros_ns,
                                           const DdsFrames& frames) noexcept {
  ros::PoseWithCovarianceStamped message{};
  message.header = RosHeader(ros_ns, frames.camera);
  message.pose.pose = RosPose(estimate.T_co);
  Fill(estimate.pose_covariance, message.pose.covariance);
  return message;
}

ros::TwistWithCovarianceStamped MakeRosTwist(const Estimate& estimate, std::int64_t ros_ns,
                                             const DdsFrames& frames) noexcept {
  ros::TwistWithCovarianceStamped message{};
  message.header = RosHeader(ros_ns, frames.camera);
  message.twist.twist = {Make3<ros::Vector3>(estimate.twist.linear_mps),
                         Make3<ros::Vector3>(estimate.twist.angular_rps)};
  Fill(estimate.twist_covariance, message.twist.covariance);
  return message;
}

ros::TransformStamped MakeRosTransform(const Estimate& estimate, std::int64_t ros_ns,
                                       const DdsFrames& frames) noexcept {
  return RosTransform(estimate.T_co, ros_ns, frames.camera, frames.object);
}

ros::TransformStamped MakeRosCameraTransform(const Transform<World, Camera>& T_wc,
                                             std::int64_t ros_ns,
                                             const DdsFrames& frames) noexcept {
  return RosTransform(T_wc, ros_ns, frames.world, frames.camera);
}

void DdsPath::Add(const Estimate& estimate, std::int64_t ros_ns, const DdsFrames& frames) {
  const bool in_world = estimate.has_T_wo && !frames.world.empty();
  const std::string* const frame = in_world ? &frames.world : &frames.camera;
  if (frame != frame_ || estimate.reset_counter != reset_counter_) poses_.clear();
  frame_ = frame;
  reset_counter_ = estimate.reset_counter;
  if (poses_.size() == kCapacity) poses_.erase(poses_.begin());
  poses_.push_back(
      {RosHeader(ros_ns, *frame), in_world ? RosPose(estimate.T_wo) : RosPose(estimate.T_co)});
}

ros::Path DdsPath::Message() noexcept {
  ros::Path message{};
  if (poses_.empty()) return message;
  message.header = poses_.back().header;
  posix::Lend(poses_, message.poses);
  return message;
}

}  // namespace disflow::apps
