// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include "disflow/surface_extractor.h"

namespace disflow::testing {

/// Keeps what the extractor streams, vertices of equal position merged.
class MeshCollector final : public TriangleSink {
 public:
  using Triangle = std::array<int, 3>;

  std::vector<SurfaceVertex> vertices;
  std::vector<Triangle> triangles;

  struct EdgeCounts {
    int edges = 0;
    int open = 0;       ///< Edges of one triangle only.
    int ambiguous = 0;  ///< Edges of more than two, or of two that are wound differently.
  };

  [[nodiscard]] EdgeCounts CountEdges() const {
    std::map<std::pair<int, int>, int> directed;
    for (const Triangle& triangle : triangles) {
      for (std::size_t i = 0; i < 3; ++i) ++directed[{triangle[i], triangle[(i + 1) % 3]}];
    }
    EdgeCounts counts;
    for (const auto& [edge, uses] : directed) {
      const auto opposite = directed.find({edge.second, edge.first});
      if (uses > 1) ++counts.ambiguous;
      if (opposite == directed.end()) {
        ++counts.open;
        ++counts.edges;
      } else if (edge.first < edge.second) {
        ++counts.edges;
      }
    }
    return counts;
  }

  [[nodiscard]] int EulerCharacteristic() const {
    return static_cast<int>(vertices.size()) - CountEdges().edges +
           static_cast<int>(triangles.size());
  }

  /// Twice the area, towards the side from which the triangle is counter-clockwise.
  [[nodiscard]] Vec3 AreaVector(const Triangle& triangle) const {
    const Vec3& a = vertices[static_cast<std::size_t>(triangle[0])].position_m;
    const Vec3& b = vertices[static_cast<std::size_t>(triangle[1])].position_m;
    const Vec3& c = vertices[static_cast<std::size_t>(triangle[2])].position_m;
    return (b - a).cross(c - a);
  }

 private:
  void DoOnTriangle(const SurfaceVertex& a, const SurfaceVertex& b,
                    const SurfaceVertex& c) noexcept override {
    triangles.push_back({IndexOf(a), IndexOf(b), IndexOf(c)});
  }

  int IndexOf(const SurfaceVertex& vertex) {
    const std::array<float, 3> key{vertex.position_m.x(), vertex.position_m.y(),
                                   vertex.position_m.z()};
    const auto [entry, is_new] = index_.try_emplace(key, static_cast<int>(vertices.size()));
    if (is_new) vertices.push_back(vertex);
    return entry->second;
  }

  std::map<std::array<float, 3>, int> index_;
};

}  // namespace disflow::testing
