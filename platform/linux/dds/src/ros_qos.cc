// SPDX-License-Identifier: BSD-3-Clause
#include "ros_qos.h"

namespace disflow::posix {
namespace {

std::int32_t DepthOf(RosQos profile) noexcept {
  switch (profile) {
    case RosQos::kReliable:
    case RosQos::kLatchedMany:
      return 100;
    case RosQos::kLatched:
      return 1;
    case RosQos::kSensorData:
      return 5;
  }
  return 1;
}

}  // namespace

Qos MakeQos(RosQos profile, const std::string& user_data) {
  Qos qos(dds_create_qos());
  const std::int32_t depth = DepthOf(profile);
  const bool best_effort = profile == RosQos::kSensorData;
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
  dds_qset_reliability(qos.get(),
                       best_effort ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
                       DDS_MSECS(100));
  if (profile == RosQos::kLatched || profile == RosQos::kLatchedMany) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  }
  if (!user_data.empty()) dds_qset_userdata(qos.get(), user_data.data(), user_data.size());
  return qos;
}

}  // namespace disflow::posix
