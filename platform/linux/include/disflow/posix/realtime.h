// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/hal/fault.h"

/// @file
/// What a program asks of the kernel to answer in time. The system may refuse each of these; the
/// program works all the same, only less regularly.

namespace disflow::posix {

/// Runs the calling thread on one processor only.
/// @return kOk, kNotFound (no such processor, or not ours), kPermissionDenied.
[[nodiscard]] hal::Fault PinThisThread(int cpu) noexcept;

/// Gives the calling thread SCHED_FIFO: it runs before all ordinary threads.
/// @param priority 1 (least) to 99.
/// @return kOk, kPermissionDenied (the message says what to grant), kUnsupported.
[[nodiscard]] hal::Fault SetThisThreadPriority(int priority) noexcept;

/// Keeps all present and future memory of the process in RAM, and touches the calling thread's
/// stack, so that no page fault comes later.
/// @return kOk, kPermissionDenied (the message says what to grant), kIoError.
[[nodiscard]] hal::Fault LockMemory() noexcept;

/// Touches the calling thread's stack as far down as the tracker will need it.
void PrefaultStack() noexcept;

}  // namespace disflow::posix
