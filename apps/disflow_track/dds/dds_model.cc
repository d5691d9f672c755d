// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_model.h"

#include "program/exit_status.h"

namespace disflow::apps {
namespace {

using posix::RosQos;

constexpr std::int64_t kPatience_ns = 1'000'000'000;

}  // namespace

DdsModel::DdsModel(const std::string& prefix, ObjectChannel& channel, ChannelReader& reader,
                   posix::RosNode& node, DdsCounters& counters)
    : channel_(channel), reader_(reader), counters_(counters) {
  Require(node.Advertise(prefix + "cloud", RosQos::kSensorData, cloud_publisher_));
  Require(node.Advertise(prefix + "distance_flow", RosQos::kSensorData, flow_publisher_));
  Require(node.Advertise(prefix + "surface", RosQos::kLatched, surface_publisher_));
  Require(node.Serve(prefix + "query_distance_field", queries_.service()));
}

void DdsModel::Turn(std::int64_t now_ns, DdsClock& clock, const DdsFrames& frames) {
  queries_.Receive(frames);
  if (asked_) {
    ModelSnapshot* const snapshot = reader_.snapshot();
    if (snapshot == nullptr) {
      if (now_ns - asked_ns_ > kPatience_ns) queries_.GiveUp(frames);
    } else {
      const std::int64_t ros_ns = clock.ToRos(snapshot->result().estimate.stamp_ns);
      Publish(*snapshot, ros_ns, frames);
      queries_.Answer(*snapshot, ros_ns, frames);
      asked_ = queries_.AwaitsSnapshot();
    }
  }
  if (asked_ || !Plan(now_ns)) return;
  reader_.RequestSnapshot();
  queries_.SnapshotAsked();
  asked_ = true;
  asked_ns_ = now_ns;
}

bool DdsModel::Plan(std::int64_t now_ns) {
  // All of them, for each is to be planned.
  const bool cloud = IsDue(cloud_plan_, cloud_publisher_.HasListeners(), now_ns);
  const bool flow = IsDue(flow_plan_, flow_publisher_.HasListeners(), now_ns);
  const bool surface = IsDue(surface_plan_, surface_publisher_.HasListeners(), now_ns);
  return cloud || flow || surface || queries_.NeedsSnapshot();
}

bool DdsModel::IsDue(Slow& slow, bool listened, std::int64_t now_ns) noexcept {
  slow.due = listened && now_ns >= slow.next_ns;
  if (slow.due) slow.next_ns = now_ns + slow.period_ns;
  return slow.due;
}

void DdsModel::Publish(ModelSnapshot& snapshot, std::int64_t ros_ns, const DdsFrames& frames) {
  if (flow_plan_.due) counters_.Publish(flow_publisher_, flow_.Message(snapshot, ros_ns, frames));
  if (cloud_plan_.due) {
    counters_.Publish(cloud_publisher_, cloud_.Message(snapshot, ros_ns, frames));
  }
  if (surface_plan_.due) {
    counters_.Publish(surface_publisher_,
                      surface_.Message(snapshot, channel_.index(), ros_ns, frames));
  }
  flow_plan_.due = cloud_plan_.due = surface_plan_.due = false;
}

}  // namespace disflow::apps
