// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "disflow/hal/depth_sensor.h"
#include "input/side_inputs.h"
#include "objects/object_channel.h"

namespace disflow::posix {
class RosNode;
}

namespace disflow::apps {

class DdsPublisher;

/// Shows the tracked objects to ROS 2, from a thread of its own: docs/ros2.md.
class DdsOutput {
 public:
  /// @param uri See ParseDdsAddress(); empty: nothing is sent.
  /// @param objects All outlive this.
  /// @param sensor Where the frames come from: it tells which clock stamps are of.
  /// @param inputs Get what is heard from ROS.
  /// @param node Of a sensor that is ROS's own; null: none. Used if it is in the same domain.
  /// @throws Failure kWrongUsage for a wrong address or if this program was built without DDS,
  /// kOutputFailed if DDS cannot be started.
  DdsOutput(const std::string& uri, std::span<ObjectChannel* const> objects,
            const hal::SensorInfo& sensor, SideInputs& inputs,
            std::shared_ptr<posix::RosNode> node);
  DdsOutput(const DdsOutput&) = delete;
  DdsOutput& operator=(const DdsOutput&) = delete;
  ~DdsOutput();

  /// Sends what is left; nothing more comes.
  void Finish();
  /// @return Lines for people, after Finish().
  [[nodiscard]] std::vector<std::string> Summary() const;

 private:
  std::unique_ptr<DdsPublisher> publisher_;  ///< Null: nothing is sent.
};

}  // namespace disflow::apps
