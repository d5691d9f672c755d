// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "board_connection.h"
#include "disflow/estimate.h"
#include "disflow/geometry/transform.h"

namespace disflow::apps {

/// Pose of the object in the camera's optical frame, out of an ODOMETRY with frame_id BODY_FRD.
[[nodiscard]] PoseCameraFromObject PoseOf(const hal::mavlink::Odometry& odometry);
[[nodiscard]] Twist TwistOf(const hal::mavlink::Odometry& odometry);

/// The controller's answers as a trajectory that disflow_eval reads.
class AnswerCsv {
 public:
  /// @return kIoError if the file cannot be written.
  [[nodiscard]] hal::Fault Open(const std::string& path);
  /// @param index Of the frame in the sequence. Nothing is written for a frame without pose.
  void Add(std::int64_t index, StampNs stamp_ns, const BoardAnswer& answer);
  /// @return kIoError if not all could be written.
  [[nodiscard]] hal::Fault Close();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace disflow::apps
