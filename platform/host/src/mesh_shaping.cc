// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/mesh_shaping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "disflow/host/random.h"

namespace disflow::host {
namespace {

/// The middles of those edges that are too long, each made once for the two triangles that meet
/// there.
class Middles {
 public:
  Middles(TriangleMesh& mesh, double longest_edge_m)
      : vertices_(mesh.vertices), longest_edge_m_(longest_edge_m) {}

  /// @return Its index; of the edge's first vertex, if the edge is short enough.
  std::uint32_t Of(std::uint32_t a, std::uint32_t b) {
    if ((vertices_[a] - vertices_[b]).norm() <= longest_edge_m_) return a;
    const auto [found, is_new] =
        made_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) vertices_.push_back(Vec3d(0.5 * (vertices_[a] + vertices_[b])));
    return found->second;
  }

 private:
  std::vector<Vec3d>& vertices_;
  double longest_edge_m_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made_;
};

/// Splits a triangle at the middles of its long edges.
void Split(const TriangleMesh::Triangle& t, Middles& middles,
           std::vector<TriangleMesh::Triangle>& pieces) {
  const std::array<std::uint32_t, 3> middle{middles.Of(t[0], t[1]), middles.Of(t[1], t[2]),
                                            middles.Of(t[2], t[0])};
  const auto is_long = [&](std::size_t edge) { return middle[edge] != t[edge]; };
  const auto count = std::count_if(middle.begin(), middle.end(), [&](const auto& m) {
    return is_long(static_cast<std::size_t>(&m - middle.data()));
  });
  if (count == 0) {
    pieces.push_back(t);
  } else if (count == 3) {
    pieces.push_back({t[0], middle[0], middle[2]});
    pieces.push_back({middle[0], t[1], middle[1]});
    pieces.push_back({middle[2], middle[1], t[2]});
    pieces.push_back(middle);
  } else {
    // Turned so that the first edge is long, and the last one is short.
    std::size_t first = 0;
    while (!is_long(first) || is_long((first + 2) % 3)) ++first;
    const std::uint32_t a = t[first];
    const std::uint32_t b = t[(first + 1) % 3];
    const std::uint32_t c = t[(first + 2) % 3];
    const std::uint32_t ab = middle[first];
    if (count == 2) {
      const std::uint32_t bc = middle[(first + 1) % 3];
      pieces.push_back({ab, b, bc});
      pieces.push_back({a, ab, bc});
      pieces.push_back({a, bc, c});
    } else {
      pieces.push_back({a, ab, c});
      pieces.push_back({ab, b, c});
    }
  }
}

/// A smooth random field: waves of random directions, lengths and phases. Its variance is 1.
class SmoothField {
 public:
  explicit SmoothField(std::uint64_t stream) {
    constexpr double kShortest_m = 0.012;
    constexpr double kLongest_m = 0.060;
    RandomNumbers random(1, stream);
    for (Wave& wave : waves_) {
      const double length_m =
          kShortest_m * std::pow(kLongest_m / kShortest_m, random.Uniform(0.0, 1.0));
      const double z = random.Uniform(-1.0, 1.0);
      const double turn = random.Uniform(0.0, 2.0 * std::numbers::pi);
      const double across = std::sqrt(1.0 - z * z);
      wave.number_per_m = 2.0 * std::numbers::pi / length_m *
                          Vec3d(across * std::cos(turn), across * std::sin(turn), z);
      wave.phase = random.Uniform(0.0, 2.0 * std::numbers::pi);
    }
  }

  [[nodiscard]] double At(const Vec3d& x) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::cos(wave.number_per_m.dot(x) + wave.phase);
    return std::sqrt(2.0 / static_cast<double>(waves_.size())) * sum;
  }

 private:
  struct Wave {
    Vec3d number_per_m;
    double phase;
  };
  std::array<Wave, 24> waves_;
};

}  // namespace

void Refine(TriangleMesh& mesh, double longest_edge_m) {
  for (std::size_t before = 0; before != mesh.triangles.size();) {
    before = mesh.triangles.size();
    Middles middles(mesh, longest_edge_m);
    std::vector<TriangleMesh::Triangle> pieces;
    for (const TriangleMesh::Triangle& triangle : mesh.triangles) Split(triangle, middles, pieces);
    mesh.triangles = std::move(pieces);
  }
}

void BulgeFaces(TriangleMesh& mesh, double edge_radius_m, double bulge_m) {
  constexpr double kLongestEdge_m = 0.006;
  constexpr double kOnFace_m = 1e-9;
  Vec3d half_m = Vec3d::Zero();
  for (const Vec3d& vertex : mesh.vertices) half_m = half_m.cwiseMax(vertex);
  const Vec3d flat_m = half_m - Vec3d::Constant(edge_radius_m);
  Refine(mesh, kLongestEdge_m);
  for (Vec3d& vertex : mesh.vertices) {
    const Vec3d x = vertex;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(x[axis]) < half_m[axis] - kOnFace_m) continue;
      double height = bulge_m;
      for (const int other : {(axis + 1) % 3, (axis + 2) % 3})
        height *= std::max(0.0, 1.0 - std::pow(x[other] / flat_m[other], 2));
      vertex[axis] += std::copysign(height, x[axis]);
    }
  }
}

void Warp(TriangleMesh& mesh, double std_m) {
  constexpr double kLongestEdge_m = 0.004;  // a third of the shortest wave
  Refine(mesh, kLongestEdge_m);
  const std::array<SmoothField, 3> fields{SmoothField(31), SmoothField(32), SmoothField(33)};
  for (Vec3d& vertex : mesh.vertices) {
    const Vec3d x = vertex;
    for (int axis = 0; axis < 3; ++axis)
      vertex[axis] += std_m * fields[static_cast<std::size_t>(axis)].At(x);
  }
}

}  // namespace disflow::host
