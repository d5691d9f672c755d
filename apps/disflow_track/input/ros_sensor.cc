// SPDX-License-Identifier: BSD-3-Clause
#include "input/ros_sensor.h"

#include "disflow/posix/dds/ros_depth_sensor.h"
#include "disflow/types.h"
#include "input/ros_node_options.h"
#include "program/exit_status.h"
#include "program/stop_signal.h"
#include "settings/dds_address.h"

namespace disflow::apps {
namespace {

constexpr int kMostSaid = 8;

/// Drivers are started together with this program and need seconds for their camera.
void AwaitFirstImage(hal::DepthSensor& sensor, std::uint32_t wait_s, Console& console) {
  posix::MonotonicClock clock;
  const std::int64_t begin_ns = clock.NowNs();
  std::string said;
  int left_to_say = kMostSaid;
  for (;;) {
    const hal::Fault fault = sensor.Open();
    if (fault.ok()) return;
    const std::int64_t waited_ns = clock.NowNs() - begin_ns;
    if (fault.status != Status::kNotFound || waited_ns >= wait_s * kSecond_ns) {
      throw Failure(kInputFailed, fault.message);
    }
    if (StopRequested()) throw Failure(kDone, "stopped before the first image came");
    if (waited_ns < kSecond_ns || said == fault.message || left_to_say == 0) continue;
    --left_to_say;
    said = fault.message;
    console.Say(said + "; waiting, " + std::to_string(wait_s) + " s in all");
  }
}

}  // namespace

std::shared_ptr<posix::RosNode> OpenRosSensor(const Options& options, host::Sensor& sensor,
                                              Console& console) {
  const DdsSensorAddress address = ParseDdsSensorAddress(options.sensor);
  auto node = std::make_shared<posix::RosNode>();
  Require(node->Open(NodeOptions(SensorNode(address, options.dds_link))), kInputFailed);
  posix::RosDepthSensor::Options topics;
  topics.depth_topic = address.depth_topic;
  topics.info_topic =
      address.info_topic.empty() ? posix::CameraInfoTopic(address.depth_topic) : address.info_topic;
  topics.rectified = address.rectified.value_or(posix::IsRectifiedTopic(address.depth_topic));
  AwaitFirstImage(sensor.Emplace<posix::RosDepthSensor>(node, topics), address.wait_s, console);
  return node;
}

}  // namespace disflow::apps
