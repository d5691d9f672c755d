// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow::apps {

/// SIGINT, SIGTERM and SIGHUP ask for a clean stop; the second one ends the program at once.
/// SIGPIPE and SIGXFSZ are ignored: a reader that went away and a file that may not grow further
/// are output errors like any other.
void InstallStopSignals() noexcept;

[[nodiscard]] bool StopRequested() noexcept;

}  // namespace disflow::apps
