// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "disflow/host/triangle_mesh.h"

namespace disflow::host {

/// Whether every edge has one triangle on either side. Points with one place are one vertex: tips
/// are drawn many times.
inline testing::AssertionResult IsClosed(const TriangleMesh& mesh) {
  std::map<std::array<double, 3>, int> places;
  std::vector<int> place;
  for (const Vec3d& v : mesh.vertices) {
    place.push_back(
        places.try_emplace({v.x(), v.y(), v.z()}, static_cast<int>(places.size())).first->second);
  }
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{place[t[i]], place[t[(i + 1) % 3]]}];
  }
  for (const auto& [edge, count] : edges) {
    if (count != 1) return testing::AssertionFailure() << "an edge is used twice in one direction";
    if (edges.count({edge.second, edge.first}) != 1)
      return testing::AssertionFailure() << "an edge has no other side";
  }
  return testing::AssertionSuccess();
}

}  // namespace disflow::host
