// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/posix/dds/ros_node.h"
#include "settings/dds_address.h"

namespace disflow::apps {

/// The node that an address describes.
[[nodiscard]] inline posix::RosNode::Options NodeOptions(const DdsNodeAddress& address) {
  return {.network = {address.domain, address.interface, address.peers},
          .name = address.name,
          .node_namespace = address.node_namespace,
          .before_iron = address.before_iron};
}

}  // namespace disflow::apps
