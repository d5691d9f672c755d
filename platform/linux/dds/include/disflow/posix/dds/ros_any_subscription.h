// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "disflow/posix/dds/ros_node.h"

namespace disflow::posix {

/// The writers that a reader hears now, sorted: the same ones give the same list.
[[nodiscard]] std::vector<dds_instance_handle_t> WritersOf(dds_entity_t reader);

/// Reads one topic of all writers, whatever they offer. DDS connects a reader only to writers that
/// offer what it asks for: a reliable one misses those of best effort, one of best effort gets
/// nothing that was published before it came. So there are two, and the second passes over those
/// that the first hears. Valid as long as its node.
template <class Message>
class RosAnySubscription {
 public:
  /// @param wanted What those writers are asked for that offer it.
  [[nodiscard]] hal::Fault Subscribe(RosNode& node, const std::string& name, RosQos wanted) {
    const hal::Fault fault = node.Subscribe(name, wanted, wanted_);
    return fault.ok() ? node.Subscribe(name, RosQos::kSensorData, all_) : fault;
  }

  /// As RosSubscription::TakeAll().
  template <class Take>
  void TakeAll(Take&& take) {
    wanted_.TakeAll(take);
    std::vector<dds_instance_handle_t> heard;
    bool known = false;
    all_.TakeAllOf(
        [&](dds_instance_handle_t writer) {
          if (!std::exchange(known, true)) heard = WritersOf(wanted_.reader());
          return !std::binary_search(heard.begin(), heard.end(), writer);
        },
        take);
  }

  /// Writers that are there now.
  [[nodiscard]] std::uint32_t writers() const noexcept { return all_.writers(); }
  /// Those among them that offer what was wanted.
  [[nodiscard]] std::vector<dds_instance_handle_t> WantedWriters() const {
    return WritersOf(wanted_.reader());
  }
  [[nodiscard]] dds_entity_t wanted_reader() const noexcept { return wanted_.reader(); }
  [[nodiscard]] dds_entity_t all_reader() const noexcept { return all_.reader(); }

 private:
  RosSubscription<Message> wanted_;
  RosSubscription<Message> all_;
};

}  // namespace disflow::posix
