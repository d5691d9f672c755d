// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/posix/file_descriptor.h"

namespace disflow::apps {

/// SIGHUP as what it means for a service: "read your settings again". For a program in a terminal
/// it also says that the terminal has gone, which ends the run as before.
class HangupSignal {
 public:
  /// From now on SIGHUP is taken by this object, of which there is one at most.
  HangupSignal() noexcept;
  HangupSignal(const HangupSignal&) = delete;
  HangupSignal& operator=(const HangupSignal&) = delete;
  /// SIGHUP asks for a clean stop again.
  ~HangupSignal();

  /// Waits for the next one; of many that come at once one is told. One that says that the terminal
  /// has gone asks for a clean stop instead.
  /// @return false after End().
  [[nodiscard]] bool Wait() noexcept;
  /// By any thread: nobody is to wait any more.
  void End() noexcept;

 private:
  posix::FileDescriptor told_;
  posix::FileDescriptor end_;
  bool had_terminal_;
};

}  // namespace disflow::apps
