// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "disflow/hal/depth_sensor.h"
#include "disflow/posix/rosbag/bag_address.h"

namespace disflow::posix {

/// Plays depth images of a ROS recording, frame by frame, as fast as it is asked to. Stamps are
/// those of the messages' headers, in the order in which they were recorded; the tracker judges
/// them. A frame goes with the newest mask and the newest intrinsics that are not younger than
/// itself; before the first mask it has an empty one, before the first intrinsics these.
///
/// What is damaged is lost, and the rest goes on: Next() says kCorrupt or kTruncated. Three pieces
/// of the file, one per topic, are in memory at a time.
class BagSensor final : public hal::DepthSensor {
 public:
  explicit BagSensor(BagOptions options);
  ~BagSensor();

  /// What is not whole although it can be played, and which depth images were found if the options
  /// name none, for people; empty: neither.
  [[nodiscard]] const std::string& note() const;

 private:
  struct State;

  hal::Fault DoOpen() noexcept override;
  hal::Fault DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept override;
  void DoClose() noexcept override;
  [[nodiscard]] hal::SensorInfo DoInfo() const noexcept override;
  [[nodiscard]] hal::SensorCounters DoCounters() const noexcept override;

  BagOptions options_;
  std::string name_;
  std::unique_ptr<State> state_;
};

}  // namespace disflow::posix
