// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/dds/ros_any_subscription.h"

namespace disflow::posix {

std::vector<dds_instance_handle_t> WritersOf(dds_entity_t reader) {
  std::vector<dds_instance_handle_t> writers;
  // As many as there are; more may come between the two calls.
  for (;;) {
    const dds_return_t count = dds_get_matched_publications(reader, writers.data(), writers.size());
    const bool all = count <= static_cast<dds_return_t>(writers.size());
    writers.resize(static_cast<std::size_t>(std::max(count, 0)));
    if (all) break;
  }
  std::sort(writers.begin(), writers.end());
  return writers;
}

}  // namespace disflow::posix
