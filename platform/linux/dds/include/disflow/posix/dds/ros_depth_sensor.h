// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "disflow/hal/depth_sensor.h"
#include "disflow/posix/dds/ros_any_subscription.h"
#include "disflow/posix/dds/ros_depth_topic.h"
#include "disflow/posix/dds/ros_node.h"
#include "disflow/posix/monotonic_clock.h"
#include "disflow/posix/ros/ros_camera_info.h"

namespace disflow::posix {

/// Depth images that a ROS 2 node publishes. What it does in which case: docs/ros2.md.
///
/// Stamps are those of the messages' headers. Next() delivers the newest good image; older ones are
/// counted as skipped. Once open it gets no memory but what Cyclone DDS and libpng need for a
/// message while it comes in. Neither texts nor sizes nor numbers of a message are trusted.
class RosDepthSensor final : public hal::DepthSensor {
 public:
  struct Options {
    std::string depth_topic;  ///< See RosDepthTopic.
    std::string info_topic;   ///< sensor_msgs/CameraInfo.
    bool rectified = false;   ///< The images are; see ReadCameraInfo().
  };

  /// @param node Open; shared with whoever else speaks to ROS here.
  RosDepthSensor(std::shared_ptr<RosNode> node, const Options& options);

 private:
  /// Waits a moment for the first image and its intrinsics.
  /// @return kNotFound: not there yet, and what is missing; call it again.
  hal::Fault DoOpen() noexcept override;
  hal::Fault DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept override;
  void DoClose() noexcept override;
  [[nodiscard]] hal::SensorInfo DoInfo() const noexcept override;
  [[nodiscard]] hal::SensorCounters DoCounters() const noexcept override;

  [[nodiscard]] hal::Fault Subscribe();
  [[nodiscard]] hal::Fault Reopen();
  void ForgetIntrinsics();
  void TakeInfos();
  [[nodiscard]] hal::Fault TakeImages();
  void FixSize(const DepthView& depth);
  [[nodiscard]] hal::Fault JudgePending() const;
  [[nodiscard]] hal::Fault Silence(std::int64_t now_ns, std::int64_t deadline_ns);
  [[nodiscard]] hal::Fault Refuse(const hal::Fault& fault);
  [[nodiscard]] hal::Fault Missing() const;
  void Lend(DepthFrame& frame);

  std::shared_ptr<RosNode> node_;
  Options options_;
  std::string name_;  ///< For people.
  MonotonicClock clock_;
  RosDepthTopic images_;
  /// Drivers that publish them once keep them for those who come later.
  RosAnySubscription<ros::CameraInfo> infos_;
  std::vector<dds_instance_handle_t> lost_infos_;  ///< Who kept some when the images went.
  RosWait wait_;
  hal::SensorCounters counters_;
  RosIntrinsics intrinsics_;
  hal::Fault intrinsics_fault_;  ///< Why there are none.
  RosDepthTopic::Image newest_;
  bool pending_ = false;  ///< newest_ has not been delivered.
  bool subscribed_ = false;
  bool open_ = false;
  bool lost_ = false;
  bool silent_ = false;  ///< It was said that nothing comes.
  int width_px_ = 0;     ///< 0: no image has come yet.
  int height_px_ = 0;
  std::int64_t alive_ns_ = 0;
};

}  // namespace disflow::posix
