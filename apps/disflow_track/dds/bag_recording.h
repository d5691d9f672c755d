// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/depth_sensor.h"
#include "objects/sample_list.h"
#include "program/frame_result.h"
#include "settings/options.h"

namespace disflow::apps {

/// Records frames and results as messages of ROS 2 in an MCAP file: docs/ros2.md. They are those
/// that `--link dds:` sends.
class BagRecording {
 public:
  /// @return Whether a path of --record is meant for this.
  [[nodiscard]] static bool IsMeant(const std::string& path) { return path.ends_with(".mcap"); }

  /// @param sensor Where the frames come from: it tells which clock stamps are of.
  /// @throws Failure kOutputFailed if the file is there already or cannot be created, kWrongUsage
  /// if this program was built without.
  BagRecording(const Options& options, const hal::SensorInfo& sensor);
  BagRecording(const BagRecording&) = delete;
  BagRecording& operator=(const BagRecording&) = delete;
  ~BagRecording();

  /// Hands a frame and its results to the kernel, all or nothing.
  /// @param frame Null if it could not be read.
  /// @param results,models In the order of Options::objects; no models: they are not due.
  [[nodiscard]] hal::Fault Add(const DepthFrame* frame, std::span<const FrameResult> results,
                               std::span<const SampleList> models);
  /// Writes the index. No more can be added then.
  [[nodiscard]] hal::Fault Finish();
  [[nodiscard]] int frame_count() const noexcept;
  [[nodiscard]] std::int64_t size_bytes() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace disflow::apps
