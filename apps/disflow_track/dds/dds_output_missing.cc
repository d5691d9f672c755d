// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_output.h"
#include "program/exit_status.h"
#include "settings/dds_address.h"

/// @file
/// In the place of dds_output.cc in a program that is built without Cyclone DDS.

namespace disflow::apps {

class DdsPublisher {};

DdsOutput::DdsOutput(const std::string& uri, std::span<ObjectChannel* const>,
                     const hal::SensorInfo&, SideInputs&, std::shared_ptr<posix::RosNode>) {
  if (uri.empty()) return;
  (void)ParseDdsAddress(uri);
  throw Failure(kWrongUsage, "link '" + uri +
                                 "': this program was built without DDS "
                                 "(DISFLOW_WITH_DDS=OFF)");
}

DdsOutput::~DdsOutput() = default;
void DdsOutput::Finish() {}
std::vector<std::string> DdsOutput::Summary() const { return {}; }

}  // namespace disflow::apps
