// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstring>
#include <string>

#include "disflow/types.h"

/// @file
/// Values as a binary little-endian PLY holds them.

namespace disflow::apps {

static_assert(std::endian::native == std::endian::little, "values are copied as they are");

template <class Value>
void AppendBytes(const Value& value, std::string& bytes) {
  char raw[sizeof(Value)];
  std::memcpy(raw, &value, sizeof(Value));
  bytes.append(raw, sizeof(Value));
}

inline void AppendBytes(const Vec3& vector, std::string& bytes) {
  for (int i = 0; i < 3; ++i) AppendBytes(vector[i], bytes);
}

}  // namespace disflow::apps
