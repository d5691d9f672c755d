// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow::apps {

/// SIGINT, SIGTERM and SIGHUP ask for a clean stop; the second one ends the program at once.
/// SIGPIPE is ignored: a reader that went away is an output error like any other.
void InstallStopSignals() noexcept;

[[nodiscard]] bool StopRequested() noexcept;

}  // namespace disflow::apps
