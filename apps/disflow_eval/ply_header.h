// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace disflow::apps {

enum class PlyType : std::uint8_t {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64
};

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;
  std::optional<PlyType> count_type;  ///< Set for lists.
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

/// What a PLY file says about itself.
struct PlyHeader {
  bool binary = false;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< Bytes, so where the data starts.
};

/// @param text The whole file. @throws InputError naming file and line.
[[nodiscard]] PlyHeader ParsePlyHeader(const std::filesystem::path& file, std::string_view text);

}  // namespace disflow::apps
