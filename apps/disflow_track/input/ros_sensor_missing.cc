// SPDX-License-Identifier: BSD-3-Clause
#include "input/ros_sensor.h"
#include "program/exit_status.h"
#include "settings/dds_address.h"

/// @file
/// In the place of ros_sensor.cc in a program that is built without Cyclone DDS.

namespace disflow::apps {

std::shared_ptr<posix::RosNode> OpenRosSensor(const Options& options, host::Sensor&, Console&) {
  throw Failure(kWrongUsage, "sensor '" + options.sensor +
                                 "': this program was built without DDS "
                                 "(DISFLOW_WITH_DDS=OFF)");
}

}  // namespace disflow::apps
