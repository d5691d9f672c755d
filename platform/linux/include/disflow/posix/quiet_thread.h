// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <thread>

namespace disflow::posix {

/// Starts a thread that gives way to others: with less of the processor's time where that is
/// scarce, and without signals, which are for the thread that tracks: they shall interrupt what it
/// waits for. To be called before the caller asks for real-time scheduling, which is inherited.
[[nodiscard]] std::thread StartQuietThread(std::function<void()> work);

}  // namespace disflow::posix
