// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "disflow/hal/link_address.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using disflow::hal::LinkAddress;
  LinkAddress address;
  const std::string_view uri(reinterpret_cast<const char*>(data), size);
  const disflow::hal::Fault fault = disflow::hal::ParseLinkAddress(uri, address);
  const bool is_named = std::strlen(fault.message) > 0;
  if (fault.ok() == is_named) std::abort();
  if (std::memchr(address.host, 0, sizeof(address.host)) == nullptr) std::abort();
  if (std::memchr(address.device, 0, sizeof(address.device)) == nullptr) std::abort();
  if (std::memchr(address.key_file, 0, sizeof(address.key_file)) == nullptr) std::abort();
  if (fault.ok() && address.kind == LinkAddress::Kind::kUdp && address.port == 0) std::abort();
  return 0;
}
