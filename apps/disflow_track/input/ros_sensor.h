// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "disflow/host/open_sensor.h"
#include "program/console.h"
#include "settings/options.h"

namespace disflow::posix {
class RosNode;
}

namespace disflow::apps {

/// Makes and opens `--sensor dds:…`, and waits for its first image as long as the address says.
/// @return The node that it is part of; a `--link dds:` of the same domain belongs to it too.
/// @throws Failure kWrongUsage, also if this program was built without DDS; kInputFailed; kDone
/// after a stop signal.
[[nodiscard]] std::shared_ptr<posix::RosNode> OpenRosSensor(const Options& options,
                                                            host::Sensor& sensor, Console& console);

}  // namespace disflow::apps
