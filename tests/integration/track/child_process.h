// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace disflow::test {

using Arguments = std::vector<std::string>;

/// How a program ended and what it said.
struct Outcome {
  int exit_status = -1;  ///< Negative: ended by that signal.
  std::string out;
  std::string err;
};

/// A program of the build, started through the cross-compiling emulator where there is one.
class ChildProcess {
 public:
  /// Both streams go to files in `scratch`, so that a program that says much never blocks.
  ChildProcess(const std::string& program, const Arguments& arguments,
               const std::filesystem::path& scratch);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  [[nodiscard]] pid_t pid() const noexcept { return pid_; }
  void Signal(int signal_number) const;
  /// What it has said on standard error so far.
  [[nodiscard]] std::string said() const;
  /// Waits for its end.
  [[nodiscard]] Outcome Wait();

 private:
  std::filesystem::path out_;
  std::filesystem::path err_;
  pid_t pid_ = -1;
};

/// Runs disflow_track to its end.
[[nodiscard]] Outcome RunTrack(const Arguments& arguments, const std::filesystem::path& scratch);
/// Runs disflow_sim to its end.
[[nodiscard]] Outcome RunSim(const Arguments& arguments, const std::filesystem::path& scratch);

}  // namespace disflow::test
