// SPDX-License-Identifier: BSD-3-Clause
#include "surface_mesh.h"

#include <algorithm>
#include <bit>
#include <cstdio>

#include "ply_bytes.h"

namespace disflow::apps {
namespace {

std::string PlyHeader(const SurfaceMesh::StdRange& range, std::size_t vertices,
                      std::size_t triangles) {
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

/// Appends one line of text made by a printf format.
template <class... Values>
void AppendLine(std::string& text, const char* format, Values... values) {
  char line[160];
  (void)std::snprintf(line, sizeof(line), format, values...);
  text += line;
}

}  // namespace

std::size_t SurfaceMesh::KeyHash::operator()(const Key& key) const noexcept {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a over 32-bit words
  for (const std::uint32_t word : key) hash = (hash ^ word) * 0x100000001b3U;
  return static_cast<std::size_t>(hash ^ (hash >> 32U));
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

SurfaceMesh::StdRange SurfaceMesh::ColouredRange() const {
  if (vertices_.empty()) return {};
  std::vector<float> stds;
  stds.reserve(vertices_.size());
  for (const SurfaceVertex& vertex : vertices_) stds.push_back(vertex.std_m);
  const auto percentile = [&stds](std::size_t percent) {
    const auto nth = stds.begin() + static_cast<std::ptrdiff_t>(percent * (stds.size() - 1) / 100);
    std::nth_element(stds.begin(), nth, stds.end());
    return *nth;
  };
  return {percentile(2), percentile(98)};
}

std::vector<Colour> SurfaceMesh::Colours() const {
  const StdRange range = ColouredRange();
  const float width_m = std::max(range.high_m - range.low_m, 1e-9F);
  std::vector<Colour> colours;
  colours.reserve(vertices_.size());
  for (const SurfaceVertex& vertex : vertices_) {
    colours.push_back(MapColour((vertex.std_m - range.low_m) / width_m));
  }
  return colours;
}

std::string SurfaceMesh::FormatPly() const {
  const std::vector<Colour> colours = Colours();
  std::string ply = PlyHeader(ColouredRange(), vertices_.size(), triangles_.size());
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    AppendBytes(vertices_[i].position_m, ply);
    AppendBytes(vertices_[i].normal, ply);
    AppendBytes(colours[i], ply);
    AppendBytes(vertices_[i].std_m, ply);
  }
  for (const Triangle& triangle : triangles_) {
    AppendBytes(std::uint8_t{3}, ply);
    AppendBytes(triangle, ply);
  }
  return ply;
}

std::string SurfaceMesh::FormatObj() const {
  const auto number = [](float value) { return static_cast<double>(value); };
  const std::vector<Colour> colours = Colours();
  const StdRange range = ColouredRange();
  std::string obj;
  AppendLine(obj, "# object frame, metres; colours: std_m from %.9g (dark) to %.9g (bright)\n",
             number(range.low_m), number(range.high_m));
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vec3& x_m = vertices_[i].position_m;
    const Colour& c = colours[i];
    AppendLine(obj, "v %.9g %.9g %.9g %.4f %.4f %.4f\n", number(x_m.x()), number(x_m.y()),
               number(x_m.z()), c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
  }
  for (const SurfaceVertex& vertex : vertices_) {
    AppendLine(obj, "vn %.6g %.6g %.6g\n", number(vertex.normal.x()), number(vertex.normal.y()),
               number(vertex.normal.z()));
  }
  for (const Triangle& t : triangles_) {
    // Counted from 1; every vertex has the normal of the same number.
    AppendLine(obj, "f %u//%u %u//%u %u//%u\n", t[0] + 1U, t[0] + 1U, t[1] + 1U, t[1] + 1U,
               t[2] + 1U, t[2] + 1U);
  }
  return obj;
}

}  // namespace disflow::apps
