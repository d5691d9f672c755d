// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "disflow/host/open_sensor.h"
#include "input/ros_sensor.h"
#include "program/console.h"
#include "settings/options.h"

namespace disflow::apps {

/// Makes and opens the sensor that Options::sensor names: a camera, a ROS 2 topic, a recording of
/// ROS, a recorded or a simulated sequence.
/// @return The node that reads it, if it is a ROS 2 topic.
/// @throws Failure kWrongUsage for the address, kInputFailed if it cannot be opened.
std::shared_ptr<posix::RosNode> OpenSensor(const Options& options, host::Sensor& sensor,
                                           Console& console);

/// All cameras that are there, for --list-sensors.
[[nodiscard]] std::string ListSensors();

}  // namespace disflow::apps
