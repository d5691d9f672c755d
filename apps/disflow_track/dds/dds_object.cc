// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_object.h"

#include "program/exit_status.h"

namespace disflow::apps {
namespace {

namespace ros = posix::ros;
using posix::RosQos;

constexpr std::int64_t kPathPeriod_ns = 500'000'000;

/// Of an object's topics and services.
std::string PrefixOf(const posix::RosNode& node, const ObjectChannel& channel) {
  return node.full_name() + "/" + posix::RosNamePart(channel.name()) + "/";
}

}  // namespace

DdsObject::DdsObject(const DdsAddress& address, const ImageSize& image, bool is_first,
                     ObjectChannel& channel, NewsSignal& signal, DdsClock& clock,
                     posix::RosNode& node, TransformPublisher& transforms, DdsCounters& counters)
    : channel_(channel),
      reader_(channel.AddReader(signal)),
      clock_(clock),
      transforms_(transforms),
      counters_(counters),
      frames_{address.camera_frame, address.name + "/" + posix::RosNamePart(channel.name()),
              address.world_frame},
      status_(address.name + ": " + channel.name()),
      model_(PrefixOf(node, channel), channel, reader_, node, counters) {
  const std::string prefix = PrefixOf(node, channel);
  Require(node.Advertise(prefix + "odometry", RosQos::kReliable, odometry_));
  Require(node.Advertise(prefix + "pose", RosQos::kReliable, pose_));
  Require(node.Advertise(prefix + "twist", RosQos::kReliable, twist_));
  Require(node.Advertise(prefix + "path", RosQos::kLatched, path_publisher_));
  Require(node.Advertise(prefix + "status", RosQos::kReliable, status_publisher_));
  if (address.may_reset) Require(node.Serve(prefix + "reset", reset_.emplace()));
  if (address.may_choose) choices_.emplace(address, prefix, is_first, image, channel, node);
}

void DdsObject::Turn(std::int64_t now_ns) {
  FrameResult result;
  while (reader_.Pop(result)) PublishResult(result);
  ServeReset();
  if (choices_) choices_->Turn();
  model_.Turn(now_ns, clock_, frames_);
}

void DdsObject::ServeReset() {
  if (!reset_) return;
  reset_->requests.TakeAll([this](const ros::TriggerRequest& request) {
    channel_.RequestReset();
    static const std::string done = "the next frame starts the object anew";
    reset_->Reply({request.header, true, posix::Lend(done)});
  });
}

void DdsObject::Finish(std::int64_t now_ns) {
  Turn(now_ns);
  if (!path_.empty()) PublishPath();
}

void DdsObject::PublishResult(const FrameResult& result) {
  const Estimate& estimate = result.estimate;
  const std::int64_t ros_ns = clock_.ToRos(estimate.stamp_ns);
  counters_.Publish(status_publisher_, status_.Message(result, reader_.lost(), ros_ns, frames_));
  // These messages cannot say that they hold a prediction; who needs one continues with the twist.
  if (KindOf(estimate) != EstimateKind::kMeasured) return;
  counters_.Publish(odometry_, MakeRosOdometry(estimate, ros_ns, frames_));
  counters_.Publish(pose_, MakeRosPose(estimate, ros_ns, frames_));
  counters_.Publish(twist_, MakeRosTwist(estimate, ros_ns, frames_));
  std::vector<ros::TransformStamped> transforms = {MakeRosTransform(estimate, ros_ns, frames_)};
  ros::TFMessage message{};
  posix::Lend(transforms, message.transforms);
  counters_.Publish(transforms_, message);
  path_.Add(estimate, ros_ns, frames_);
  if (ros_ns - path_ns_ < kPathPeriod_ns) return;
  path_ns_ = ros_ns;
  PublishPath();
}

void DdsObject::PublishPath() { counters_.Publish(path_publisher_, path_.Message()); }

}  // namespace disflow::apps
