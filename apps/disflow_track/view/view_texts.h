// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "disflow/config.h"
#include "program/frame_result.h"

/// @file
/// What the live view sends as JSON: names, and what changes slowly.

namespace disflow::apps {

/// Names that frames refer to by number.
[[nodiscard]] std::string DescribeProgram(const std::string& version,
                                          std::span<const std::string> objects);

struct ViewStatus {
  bool paused = false;
  bool ended = false;  ///< No more frames will come.
  double frames_per_second = 0.0;
  std::uint32_t not_shown = 0;  ///< Frames that the view was too slow for.
};
[[nodiscard]] std::string DescribeStatus(const ViewStatus& status, const FrameResult& result);

/// Those of an object's settings that may change while it is tracked.
[[nodiscard]] std::string DescribeRunningSettings(const Config& config);

}  // namespace disflow::apps
