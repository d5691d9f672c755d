// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dds/dds.h>

#include <memory>
#include <string>

#include "disflow/posix/dds/ros_node.h"

namespace disflow::posix {

struct QosDeleter {
  void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

/// @param user_data Left out if empty.
[[nodiscard]] Qos MakeQos(RosQos profile, const std::string& user_data);

}  // namespace disflow::posix
