// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "disflow/hal/depth_sensor.h"
#include "disflow/host/replay_options.h"

namespace disflow::host {

/// Plays a recorded sequence, frame by frame, as fast as it is asked to. Layouts: Fast-YCB
/// (depth/I.float, masks/SET/OBJECT_I.png, data.txt) and folders of 16-bit PNG.
///
/// A frame whose file is missing, cut or damaged is lost: Next() says kTruncated or kCorrupt and
/// goes on with the next one. Where a mask set has no image for a frame (segmentation networks skip
/// some), the mask before it is held and counted; before the first one it is empty. Stamps and
/// mask sizes are delivered as they are: judging them is the tracker's task.
///
/// Of a recording that was cut short (the program was killed, the disk full) the frame that was
/// being written is left out; note() says so.
class ReplaySensor final : public hal::DepthSensor {
 public:
  explicit ReplaySensor(ReplayOptions options);
  ~ReplaySensor();

  [[nodiscard]] int held_masks() const;
  /// What was left out of a recording that was cut short, for people; empty if it is whole.
  [[nodiscard]] const std::string& note() const;

 private:
  struct State;

  hal::Fault DoOpen() noexcept override;
  hal::Fault DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept override;
  void DoClose() noexcept override;
  [[nodiscard]] hal::SensorInfo DoInfo() const noexcept override;
  [[nodiscard]] hal::SensorCounters DoCounters() const noexcept override;

  ReplayOptions options_;
  std::string name_;
  std::unique_ptr<State> state_;
};

}  // namespace disflow::host
