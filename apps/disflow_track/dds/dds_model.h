// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "dds/dds_clock.h"
#include "dds/dds_cloud.h"
#include "dds/dds_query.h"
#include "disflow/posix/dds/ros_node.h"
#include "objects/object_channel.h"
#include "objects/sample_list.h"

namespace disflow::apps {

/// What was written to DDS; all objects' together.
struct DdsCounters {
  std::uint64_t sent = 0;
  std::uint64_t failed = 0;

  template <class Message>
  void Publish(posix::RosPublisher<Message>& publisher, const Message& message) {
    ++(publisher.Publish(message) ? sent : failed);
  }
};

/// What of an object's topics and services needs a copy of its model. A copy is asked for only if
/// somebody wants what is made of it.
class DdsModel {
 public:
  /// @throws Failure kOutputFailed.
  DdsModel(const std::string& prefix, ObjectChannel& channel, ChannelReader& reader,
           posix::RosNode& node, DdsCounters& counters);

  /// Publishes and answers what is due.
  void Turn(std::int64_t now_ns, DdsClock& clock, const DdsFrames& frames);

 private:
  /// A topic that is published now and then.
  struct Slow {
    std::int64_t period_ns;
    std::int64_t next_ns = 0;
    bool due = false;  ///< The next copy is for this topic too.
  };

  /// @return true if a copy is wanted now.
  [[nodiscard]] bool Plan(std::int64_t now_ns);
  [[nodiscard]] bool IsDue(Slow& slow, bool listened, std::int64_t now_ns) noexcept;
  void Publish(ModelSnapshot& snapshot, std::int64_t ros_ns, const DdsFrames& frames);

  ObjectChannel& channel_;
  ChannelReader& reader_;
  DdsCounters& counters_;
  DdsQueries queries_;
  posix::RosPublisher<posix::ros::PointCloud2> cloud_publisher_;
  posix::RosPublisher<posix::ros::PointCloud2> flow_publisher_;
  posix::RosPublisher<posix::ros::Marker> surface_publisher_;
  DdsModelCloud cloud_;
  DdsFlowCloud flow_;
  DdsSurface surface_;
  Slow cloud_plan_{kModelPeriod_ns};
  Slow flow_plan_{100'000'000};
  Slow surface_plan_{2'000'000'000};
  bool asked_ = false;  ///< A copy has been asked for and has not been used up.
  std::int64_t asked_ns_ = 0;
};

}  // namespace disflow::apps
