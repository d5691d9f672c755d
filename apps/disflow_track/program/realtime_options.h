// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "program/console.h"

namespace disflow::apps {

/// What is asked of the kernel; see docs/deploy.md.
struct RealtimeOptions {
  int priority =
      0;  ///< SCHED_FIFO of the tracking threads, the capture thread has one more; 0 = none.
  /// Of the tracking thread, of the capture thread and of those that help with further objects; any
  /// that are left out are not bound.
  std::vector<int> cpus;
  bool lock_memory = false;
};

/// Asks for what was wanted, in the thread that calls it. What is refused is said; the run goes on.
void ApplyToTrackingThread(const RealtimeOptions& options, Console& console);
/// @param worker Of the threads that help the tracking thread, from 0.
void ApplyToWorkerThread(const RealtimeOptions& options, int worker, Console& console);
void ApplyToCaptureThread(const RealtimeOptions& options, Console& console);

/// Locks the memory of the whole process, if that is wanted. To be called when all of it is there.
void LockProcessMemory(const RealtimeOptions& options, Console& console);

}  // namespace disflow::apps
