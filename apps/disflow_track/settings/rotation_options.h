// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace disflow::apps {

struct Options;
struct RotationOptions;

void AddRotationOptions(CLI::App& app, RotationOptions& options);

/// @throws Failure kWrongUsage if nothing could be rotated, or nothing is.
void CheckRotation(const Options& options);

}  // namespace disflow::apps
