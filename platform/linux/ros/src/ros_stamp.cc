// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/ros/ros_stamp.h"

#include "disflow/types.h"

namespace disflow::posix {

hal::Fault ReadRosStamp(std::int32_t sec, std::uint32_t nanosec, StampNs& stamp_ns) noexcept {
  if (sec < 0 || nanosec >= kSecond_ns || (sec == 0 && nanosec == 0)) {
    return hal::MakeFault(Status::kCorrupt,
                          "header.stamp is %d.%09u, so nobody knows when it was taken", sec,
                          nanosec);
  }
  stamp_ns = StampNs{sec} * kSecond_ns + nanosec;
  return {};
}

}  // namespace disflow::posix
