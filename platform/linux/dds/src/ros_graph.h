// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dds/dds.h>

#include <span>
#include <string>

#include "disflow/hal/fault.h"

namespace disflow::posix {

/// What ROS 2 has to be told of a participant, since DDS knows no nodes.
struct GraphEntry {
  std::string node_name;
  std::string node_namespace;  ///< Empty: none.
  std::span<const dds_entity_t> readers;
  std::span<const dds_entity_t> writers;
};

/// Writes the entry to `ros_discovery_info`, where it stays for those who come later.
/// @param before_iron With ids of 24 bytes, as ROS 2 Humble and older have them.
/// @param writer 0 the first time; then what was made the first time.
[[nodiscard]] hal::Fault AnnounceInGraph(dds_entity_t participant, const GraphEntry& entry,
                                         bool before_iron, dds_entity_t& writer);

}  // namespace disflow::posix
