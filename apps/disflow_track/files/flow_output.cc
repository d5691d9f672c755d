// SPDX-License-Identifier: BSD-3-Clause
#include "files/flow_output.h"

#include <cstdio>
#include <filesystem>

#include "files/output_file.h"
#include "program/exit_status.h"

namespace disflow::apps {

FlowOutput::FlowOutput(const std::string& folder) : folder_(folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const bool is_empty = !error && std::filesystem::is_empty(folder, error);
  if (error) throw Failure(kOutputFailed, folder + ": cannot be written: " + error.message());
  if (!is_empty) {
    throw Failure(kOutputFailed, folder + ": is not empty; give another folder or clear this one");
  }
}

void FlowOutput::Write(std::int64_t frame, const Estimate& estimate) {
  char name[32];
  (void)std::snprintf(name, sizeof(name), "/%06lld.ply", static_cast<long long>(frame));
  ReplaceFile(folder_ + name, cloud_.FormatPly(estimate));
  ++files_;
}

}  // namespace disflow::apps
