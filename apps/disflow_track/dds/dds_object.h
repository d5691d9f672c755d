// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "dds/dds_choice.h"
#include "dds/dds_clock.h"
#include "dds/dds_model.h"
#include "dds/dds_motion.h"
#include "dds/dds_status.h"
#include "disflow/posix/dds/ros_node.h"
#include "objects/object_channel.h"
#include "settings/dds_address.h"

namespace disflow::apps {

/// One object's topics and services. All by the thread of DdsPublisher but for the making.
class DdsObject {
 public:
  using TransformPublisher = posix::RosPublisher<posix::ros::TFMessage>;

  /// @param image Of the sensor.
  /// @param is_first Of the run's objects.
  /// @param signal Raised when the object has news.
  /// @throws Failure kOutputFailed.
  DdsObject(const DdsAddress& address, const ImageSize& image, bool is_first,
            ObjectChannel& channel, NewsSignal& signal, DdsClock& clock, posix::RosNode& node,
            TransformPublisher& transforms, DdsCounters& counters);
  DdsObject(const DdsObject&) = delete;
  DdsObject& operator=(const DdsObject&) = delete;

  /// Publishes what is new, answers what was asked.
  void Turn(std::int64_t now_ns);
  /// Publishes what waits for its moment: nothing more comes.
  void Finish(std::int64_t now_ns);

  /// Results that were never published since DDS was too slow.
  [[nodiscard]] std::uint32_t lost() const { return reader_.lost(); }

 private:
  void PublishResult(const FrameResult& result);
  void PublishPath();
  void ServeReset();

  ObjectChannel& channel_;
  ChannelReader& reader_;
  DdsClock& clock_;
  TransformPublisher& transforms_;
  DdsCounters& counters_;
  DdsFrames frames_;
  DdsPath path_;
  std::int64_t path_ns_ = 0;  ///< ROS time of the path published last.
  DdsStatus status_;
  posix::RosPublisher<posix::ros::Odometry> odometry_;
  posix::RosPublisher<posix::ros::PoseWithCovarianceStamped> pose_;
  posix::RosPublisher<posix::ros::TwistWithCovarianceStamped> twist_;
  posix::RosPublisher<posix::ros::Path> path_publisher_;
  posix::RosPublisher<posix::ros::DiagnosticArray> status_publisher_;
  // Not there unless the address allows it.
  std::optional<posix::RosService<posix::ros::TriggerRequest, posix::ros::TriggerResponse>> reset_;
  std::optional<DdsChoices> choices_;
  DdsModel model_;
};

}  // namespace disflow::apps
