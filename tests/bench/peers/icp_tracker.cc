// SPDX-License-Identifier: BSD-3-Clause
#include "icp_tracker.h"

#include <pcl/common/centroid.h>
#include <pcl/common/transforms.h>

#include <optional>

#include "icp_registration.h"

namespace disflow::bench {
namespace {

constexpr std::size_t kFewestPoints = 50;

Cloud::Ptr Moved(const Cloud& cloud, const Eigen::Matrix4d& motion) {
  Cloud::Ptr moved(new Cloud);
  pcl::transformPointCloudWithNormals(cloud, *moved, motion);
  return moved;
}

template <class Pose>
Eigen::Matrix4d MatrixOf(const Pose& pose) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = pose.rotation();
  matrix.topRightCorner<3, 1>() = pose.translation();
  return matrix;
}

double SecondsBetween(StampNs from_ns, StampNs to_ns) {
  return static_cast<double>(to_ns - from_ns) * 1e-9;
}

}  // namespace

void IcpTracker::Process(const DepthFrame& frame, Estimate& estimate) {
  estimate = {};
  estimate.stamp_ns = frame.stamp_ns;
  const Cloud::Ptr cloud_c = MakeObjectCloud(frame, settings_);
  if (started_) {
    estimate.status = Register(*cloud_c, frame.stamp_ns);
  } else if (cloud_c->size() >= kFewestPoints) {
    Start(*cloud_c);
    T_oc_previous_ = T_oc_;
    stamp_ns_ = previous_ns_ = frame.stamp_ns;
    estimate.status = Status::kOk;
  }
  estimate.state = estimate.status == Status::kOk ? TrackingState::kTracking : TrackingState::kLost;
  estimate.T_co = T_oc_.Inverse().Cast<float>();
  estimate.twist = TwistBetween();
}

/// The object frame is at the middle of what is seen first.
void IcpTracker::Start(const Cloud& cloud_c) {
  Eigen::Vector4d middle = Eigen::Vector4d::Zero();
  pcl::compute3DCentroid(cloud_c, middle);
  T_oc_ = Pose(Pose::Matrix3::Identity(), -middle.head<3>());
  model_.Add(*Moved(cloud_c, MatrixOf(T_oc_)));
  started_ = true;
}

/// Whatever comes of it, the pose is that of the new stamp afterwards.
Status IcpTracker::Register(const Cloud& cloud_c, StampNs stamp_ns) {
  const Pose start = Predict(stamp_ns);
  T_oc_previous_ = T_oc_;
  previous_ns_ = stamp_ns_;
  T_oc_ = start;
  stamp_ns_ = stamp_ns;
  if (cloud_c.size() < kFewestPoints) return Status::kTooFewSamples;
  const Cloud::Ptr source = Moved(cloud_c, MatrixOf(start));
  const Cloud::Ptr target = model_.Facing(start.translation().cast<float>());
  const auto motion = RegisterByIcp(source, target, settings_);
  if (!motion) return Status::kRegistrationFailed;
  const Transform<Object, Object, double> correction(Pose::Matrix3(motion->topLeftCorner<3, 3>()),
                                                     Pose::Vector3(motion->topRightCorner<3, 1>()));
  T_oc_ = (correction * start).Normalized();
  model_.Add(*Moved(*source, *motion));
  return Status::kOk;
}

/// The origin goes on along its line, and the object turns on about it.
IcpTracker::Pose IcpTracker::Predict(StampNs stamp_ns) const {
  if (stamp_ns_ <= previous_ns_) return T_oc_;
  const double ratio =
      SecondsBetween(stamp_ns_, stamp_ns) / SecondsBetween(previous_ns_, stamp_ns_);
  const auto T_co = T_oc_.Inverse();
  const auto T_co_previous = T_oc_previous_.Inverse();
  const Pose::Vector3 turn = TurnBetween<double>(T_co_previous.rotation(), T_co.rotation());
  const Transform<Camera, Object, double> predicted(
      Pose::Matrix3(ExpSo3<double>(ratio * turn) * T_co.rotation()),
      Pose::Vector3(T_co.translation() +
                    ratio * (T_co.translation() - T_co_previous.translation())));
  return predicted.Inverse();
}

Twist IcpTracker::TwistBetween() const {
  if (stamp_ns_ <= previous_ns_) return {};
  const double seconds = SecondsBetween(previous_ns_, stamp_ns_);
  const auto T_co = T_oc_.Inverse();
  const auto T_co_previous = T_oc_previous_.Inverse();
  const Pose::Vector3 step = T_co.translation() - T_co_previous.translation();
  const Pose::Vector3 turn = TurnBetween<double>(T_co_previous.rotation(), T_co.rotation());
  return {(step / seconds).cast<float>(), (turn / seconds).cast<float>()};
}

}  // namespace disflow::bench
