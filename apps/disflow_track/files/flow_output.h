// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "flow_cloud.h"

namespace disflow::apps {

/// The distance flow of every frame, a PLY each, in a folder.
class FlowOutput {
 public:
  /// Makes the folder. @throws Failure kOutputFailed, also if it has files in it; what a run left
  /// behind that was killed while it wrote a file is removed and does not count.
  explicit FlowOutput(const std::string& folder);

  [[nodiscard]] FlowCloud& cloud() noexcept { return cloud_; }
  /// Writes the cloud as the file of a frame. @throws Failure kOutputFailed.
  void Write(std::int64_t frame, const Estimate& estimate);

  [[nodiscard]] const std::string& folder() const noexcept { return folder_; }
  [[nodiscard]] int files() const noexcept { return files_; }

 private:
  std::string folder_;
  FlowCloud cloud_;
  int files_ = 0;
};

}  // namespace disflow::apps
