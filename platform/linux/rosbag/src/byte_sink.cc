// SPDX-License-Identifier: BSD-3-Clause
#include "byte_sink.h"

#include <algorithm>

namespace disflow::posix {

ByteSink& ByteSink::PutBytes(std::span<const std::uint8_t> bytes) {
  const std::size_t size = bytes_.size();
  bytes_.resize(size + bytes.size());
  std::copy(bytes.begin(), bytes.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(size));
  return *this;
}

}  // namespace disflow::posix
