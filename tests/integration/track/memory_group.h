// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

#include "scratch_folder.h"

namespace disflow::test {

/// A control group with little memory and nothing to swap to. Of either version; only root may make
/// one. Its processes must have ended before it does.
class MemoryGroup {
 public:
  explicit MemoryGroup(long bytes) {
    namespace fs = std::filesystem;
    const fs::path root = "/sys/fs/cgroup";
    const bool is_new = fs::exists(root / "cgroup.controllers");
    const fs::path group =
        (is_new ? root : root / "memory") / ("disflow_test_" + std::to_string(::getpid()));
    std::error_code error;
    if (!fs::create_directory(group, error)) return;
    group_ = group;
    const std::string text = std::to_string(bytes);
    WriteFile(group / (is_new ? "memory.max" : "memory.limit_in_bytes"), text);
    WriteFile(group / (is_new ? "memory.swap.max" : "memory.memsw.limit_in_bytes"),
              is_new ? "0" : text);
    is_limited_ =
        std::atol(ReadFile(group / (is_new ? "memory.max" : "memory.limit_in_bytes")).c_str()) ==
        bytes / ::getpagesize() * ::getpagesize();
  }
  MemoryGroup(const MemoryGroup&) = delete;
  MemoryGroup& operator=(const MemoryGroup&) = delete;
  ~MemoryGroup() {
    std::error_code error;
    if (!group_.empty()) std::filesystem::remove(group_, error);
  }

  /// @return Why there is none; empty: there is one.
  [[nodiscard]] std::string refusal() const {
    return is_limited_ ? "" : "no control group with a limit of memory can be made here";
  }
  /// Whoever writes its number there belongs to the group.
  [[nodiscard]] std::string processes() const { return group_ / "cgroup.procs"; }

 private:
  std::filesystem::path group_;
  bool is_limited_ = false;
};

}  // namespace disflow::test
