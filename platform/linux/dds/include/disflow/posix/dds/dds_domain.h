// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "disflow/hal/fault.h"

namespace disflow::posix {

/// A Cyclone DDS entity, deleted with its owner. An entity's children are deleted with it.
class DdsEntity {
 public:
  DdsEntity() = default;
  explicit DdsEntity(dds_entity_t handle) noexcept : handle_(handle) {}
  DdsEntity(DdsEntity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  DdsEntity& operator=(DdsEntity&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  DdsEntity(const DdsEntity&) = delete;
  DdsEntity& operator=(const DdsEntity&) = delete;
  ~DdsEntity() {
    // What a parent took with it is gone already, and that is fine.
    if (handle_ > 0) (void)dds_delete(handle_);
  }
  [[nodiscard]] dds_entity_t handle() const noexcept { return handle_; }

 private:
  dds_entity_t handle_ = 0;
};

/// Which DDS network to join, and how.
struct DdsNetwork {
  std::uint32_t domain = 0;        ///< ROS_DOMAIN_ID.
  std::string interface;           ///< Network interface; empty: chosen by Cyclone DDS.
  std::vector<std::string> peers;  ///< Hosts to look for; empty: found by multicast.
};

inline constexpr std::uint32_t kMaxDomain = 232;  ///< Beyond, ports run out.

/// Creates the domain of this process. CYCLONEDDS_URI, if set, is read first; what the network
/// names wins over it.
/// @return kIoError with Cyclone DDS's own reason.
[[nodiscard]] hal::Fault OpenDomain(const DdsNetwork& network, DdsEntity& domain);

}  // namespace disflow::posix
