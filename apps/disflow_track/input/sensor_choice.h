// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "disflow/host/open_sensor.h"

namespace disflow::apps {

/// Makes and opens the sensor that an address names: a camera, a recorded or a simulated sequence.
/// @throws Failure kWrongUsage for the address, kInputFailed if it cannot be opened.
void OpenSensor(const std::string& uri, host::Sensor& sensor);

/// All cameras that are there, for --list-sensors.
[[nodiscard]] std::string ListSensors();

}  // namespace disflow::apps
