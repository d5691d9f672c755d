// SPDX-License-Identifier: BSD-3-Clause
#include "surface_mesh.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>

#include "colour_map.h"

namespace disflow::apps {
namespace {

static_assert(std::endian::native == std::endian::little, "the PLY is written as little endian");

template <class Value>
void AppendBytes(const Value& value, std::string& bytes) {
  char raw[sizeof(Value)];
  std::memcpy(raw, &value, sizeof(Value));
  bytes.append(raw, sizeof(Value));
}

struct StdRange {
  float low_m = 0.0F;
  float high_m = 0.0F;
};

/// A few badly known vertices at the rim must not decide the colours of all others.
StdRange ColouredRange(const std::vector<SurfaceVertex>& vertices) {
  if (vertices.empty()) return {};
  std::vector<float> stds;
  stds.reserve(vertices.size());
  for (const SurfaceVertex& vertex : vertices) stds.push_back(vertex.std_m);
  const auto percentile = [&stds](std::size_t percent) {
    const auto nth = stds.begin() + static_cast<std::ptrdiff_t>(percent * (stds.size() - 1) / 100);
    std::nth_element(stds.begin(), nth, stds.end());
    return *nth;
  };
  return {percentile(2), percentile(98)};
}

std::string PlyHeader(const StdRange& range, std::size_t vertices, std::size_t triangles) {
  char text[512];
  (void)std::snprintf(text, sizeof(text),
                      "ply\nformat binary_little_endian 1.0\n"
                      "comment object frame, metres; colours: std_m from %.9g (dark) to %.9g "
                      "(bright)\n"
                      "element vertex %zu\n"
                      "property float x\nproperty float y\nproperty float z\n"
                      "property float nx\nproperty float ny\nproperty float nz\n"
                      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                      "property float std_m\n"
                      "element face %zu\n"
                      "property list uchar int vertex_indices\nend_header\n",
                      static_cast<double>(range.low_m), static_cast<double>(range.high_m), vertices,
                      triangles);
  return text;
}

}  // namespace

std::size_t SurfaceMesh::KeyHash::operator()(const Key& key) const noexcept {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a over 32-bit words
  for (const std::uint32_t word : key) hash = (hash ^ word) * 0x100000001b3U;
  return hash ^ (hash >> 32U);
}

std::uint32_t SurfaceMesh::IndexOf(const SurfaceVertex& vertex) {
  const Key key = {std::bit_cast<std::uint32_t>(vertex.position_m.x()),
                   std::bit_cast<std::uint32_t>(vertex.position_m.y()),
                   std::bit_cast<std::uint32_t>(vertex.position_m.z())};
  const auto [entry, added] = index_.try_emplace(key, static_cast<std::uint32_t>(vertices_.size()));
  if (added) vertices_.push_back(vertex);
  return entry->second;
}

void SurfaceMesh::DoOnTriangle(const SurfaceVertex& a, const SurfaceVertex& b,
                               const SurfaceVertex& c) noexcept {
  triangles_.push_back({IndexOf(a), IndexOf(b), IndexOf(c)});
}

std::string SurfaceMesh::FormatPly() const {
  const StdRange range = ColouredRange(vertices_);
  const float width_m = std::max(range.high_m - range.low_m, 1e-9F);
  std::string ply = PlyHeader(range, vertices_.size(), triangles_.size());
  for (const SurfaceVertex& vertex : vertices_) {
    for (int i = 0; i < 3; ++i) AppendBytes(vertex.position_m[i], ply);
    for (int i = 0; i < 3; ++i) AppendBytes(vertex.normal[i], ply);
    AppendBytes(MapColour((vertex.std_m - range.low_m) / width_m), ply);
    AppendBytes(vertex.std_m, ply);
  }
  for (const auto& triangle : triangles_) {
    AppendBytes(std::uint8_t{3}, ply);
    AppendBytes(triangle, ply);
  }
  return ply;
}

}  // namespace disflow::apps
