// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "child_process.h"
#include "eventually.h"
#include "scratch_folder.h"

namespace disflow::test {

/// A disk in memory that is soon full. It is mounted where only one process sees it, which does
/// nothing else; all others reach it through that process's entry in /proc.
class SmallDisk {
 public:
  /// @param options Of tmpfs, e.g. "size=3m,nr_inodes=40".
  SmallDisk(const std::string& options, const std::filesystem::path& scratch)
      : mark_(scratch / "mounted"),
        keeper_("/usr/bin/unshare", Mounting(options, scratch), scratch) {
    const bool is_decided =
        Eventually([this] { return std::filesystem::exists(mark_) || !keeper_.said().empty(); });
    if (is_decided && std::filesystem::exists(mark_))
      path_ = "/proc/" + std::to_string(keeper_.pid()) + "/root" + (scratch / "disk").string();
  }

  /// @return Why there is none; empty: there is one.
  [[nodiscard]] std::string refusal() const {
    return path_.empty() ? "nothing can be mounted here: " + keeper_.said() : "";
  }
  [[nodiscard]] std::string Path(const std::string& name) const { return path_ + "/" + name; }
  [[nodiscard]] std::string path() const { return path_; }

  /// Takes all the room that is left.
  void Fill() const {
    const std::string block(4096, 'x');
    std::ofstream file(Path("fill"), std::ios::binary);
    while (file.write(block.data(), static_cast<std::streamsize>(block.size())).flush()) {
    }
  }
  void Empty() const { std::filesystem::remove(Path("fill")); }

 private:
  static Arguments Mounting(const std::string& options, const std::filesystem::path& scratch) {
    // Root needs no namespace of users, and may not be allowed one.
    const char* const what = ::geteuid() == 0 ? "-m" : "-rm";
    std::filesystem::create_directory(scratch / "disk");
    return {what,
            "/bin/sh",
            "-c",
            R"(cd "$1" && mount -t tmpfs -o "$0" none disk && touch mounted && exec sleep 100000)",
            options,
            scratch.string()};
  }

  std::filesystem::path mark_;
  ChildProcess keeper_;
  std::string path_;
};

}  // namespace disflow::test
