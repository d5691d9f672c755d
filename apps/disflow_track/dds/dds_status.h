// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dds/dds_motion.h"

namespace disflow::apps {

/// State, verdict and counters of a frame as diagnostics. One object's, used again and again.
class DdsStatus {
 public:
  /// @param name As diagnostics tools show it.
  explicit DdsStatus(std::string name) : name_(std::move(name)) {}

  /// @param lost Results that did not reach DDS.
  /// @return Points into this; valid until the next call.
  [[nodiscard]] posix::ros::DiagnosticArray Message(const FrameResult& result, std::uint32_t lost,
                                                    std::int64_t ros_ns, const DdsFrames& frames);

 private:
  void Add(const char* key, std::string value);

  std::string name_;
  std::string message_;
  const std::string hardware_ = "disflow_track";
  std::vector<std::array<std::string, 2>> pairs_;
  std::vector<posix::ros::KeyValue> values_;
  std::vector<posix::ros::DiagnosticStatus> status_;
};

}  // namespace disflow::apps
