// SPDX-License-Identifier: BSD-3-Clause
#include "files/flow_output.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "files/numbered_names.h"
#include "files/output_file.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExtension = ".ply";

/// Whether a name is that of a frame's file which was not complete yet.
bool IsPartOfFrame(std::string_view name) {
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  return digits > 0 && name.substr(digits) == PartPath(std::string(kExtension));
}

/// What a kill leaves behind while a file is written. Nobody waits for it any more.
/// @return Whether the folder is empty then.
bool RemoveParts(const std::string& folder, std::error_code& error) {
  bool is_empty = true;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const bool is_part = IsPartOfFrame(entry->path().filename().string());
    if (is_part) fs::remove(entry->path(), error);
    if (error) return false;
    is_empty = is_empty && is_part;
  }
  return is_empty;
}

}  // namespace

FlowOutput::FlowOutput(const std::string& folder) : folder_(folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  const bool is_empty = !error && RemoveParts(folder, error);
  if (error) throw Failure(kOutputFailed, folder + ": cannot be written: " + error.message());
  if (!is_empty) {
    throw Failure(kOutputFailed, folder + ": is not empty; " + kOtherFolder);
  }
}

void FlowOutput::Write(std::int64_t frame, const Estimate& estimate) {
  char name[32];
  (void)std::snprintf(name, sizeof(name), "/%06lld", static_cast<long long>(frame));
  ReplaceFile(folder_ + name + std::string(kExtension), cloud_.FormatPly(estimate));
  ++files_;
}

}  // namespace disflow::apps
