// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>

#include "disflow/types.h"

/// @file
/// Values as a binary little-endian PLY holds them, appended to a text or a vector of bytes.

namespace disflow::apps {

static_assert(std::endian::native == std::endian::little, "values are copied as they are");

template <class Value, class Bytes>
void AppendBytes(const Value& value, Bytes& bytes) {
  const std::size_t size = bytes.size();
  bytes.resize(size + sizeof(Value));
  std::memcpy(bytes.data() + size, &value, sizeof(Value));
}

template <class Bytes>
void AppendBytes(const Vec3& vector, Bytes& bytes) {
  for (int i = 0; i < 3; ++i) AppendBytes(vector[i], bytes);
}

}  // namespace disflow::apps
