// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "disflow/field/local_surface.h"
#include "disflow/field/marching_tetrahedra.h"
#include "disflow/field/posterior_variance.h"
#include "disflow/surface_extractor.h"

/// @file
/// Definition of ExtractSurface(). Only needed to instantiate a profile of your own; the shipped
/// ones are in the library.

namespace disflow {

template <CapacityProfile Limits>
class SurfaceExtractor {
 public:
  using Workspace = SurfaceWorkspace<Limits>;

  SurfaceExtractor(const DistanceField<Limits>& field, const SurfaceOptions& options,
                   Workspace& workspace, TriangleSink& sink) noexcept
      : field_(field),
        workspace_(workspace),
        sink_(sink),
        surface_(field, options.min_observations),
        variance_(field, workspace.gp),
        steps_(StepsPerCell(field, options)),
        step_m_(field.config().cell_size_m / static_cast<float>(steps_)),
        support_m_(
            std::fmin(field.coarseness() * options.support_radius_m, field.config().cell_size_m)) {}

  [[nodiscard]] static bool IsValid(const DistanceField<Limits>& field,
                                    const SurfaceOptions& options) noexcept {
    // Written so that NaN is refused too.
    return options.resolution_m * static_cast<float>(kMaxStepsPerCell) >=
               field.config().cell_size_m / field.coarseness() * (1.0F - kRounding) &&
           options.resolution_m < kLargest_m && options.support_radius_m > 0.0F &&
           options.support_radius_m < kLargest_m;
  }

  [[nodiscard]] SurfaceCounts Run() noexcept {
    field_.store().tree().ForEachLeaf([this](const OctreeCell& cell, Handle) {
      ExtractCell(cell);
      // Surface may stick out into cells that hold no sample.
      ForEachNeighbour(cell, [&](const OctreeCell& neighbour) {
        if (!HasLeaf(neighbour) && IsFirstLeafAround(neighbour, cell)) ExtractCell(neighbour);
        return true;
      });
    });
    return counts_;
  }

 private:
  static constexpr float kLargest_m = 1e6F;
  static constexpr float kRounding = 1e-4F;
  static constexpr float kCubeDiagonal = 1.7320508F;
  static constexpr float kEdgeMargin =
      0.01F;  ///< Vertices keep off the grid's corners: no triangle degenerates.

  using LocalValue = typename LocalSurface<Limits>::Value;
  using CachedVertex = typename Workspace::CachedVertex;

  /// Place on the grid of one cell.
  struct Corner {
    int x, y, z;
  };

  [[nodiscard]] static int StepsPerCell(const DistanceField<Limits>& field,
                                        const SurfaceOptions& options) noexcept {
    const float steps =
        std::ceil(field.config().cell_size_m / options.resolution_m * (1.0F - kRounding));
    return std::clamp(static_cast<int>(steps), 1, kMaxStepsPerCell);
  }

  [[nodiscard]] static bool Same(const OctreeCell& a, const OctreeCell& b) noexcept {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
  [[nodiscard]] bool HasLeaf(const OctreeCell& cell) const noexcept {
    return field_.store().tree().FindLeaf(cell) != kNoHandle;
  }

  /// Calls visit(neighbour) for the mapped cells around a cell until it returns false.
  template <class Visitor>
  static void ForEachNeighbour(const OctreeCell& cell, Visitor&& visit) noexcept {
    constexpr int kEnd = DistanceField<Limits>::Store::Tree::kCellsPerEdge;
    for (int z = std::max(cell.z - 1, 0); z < std::min(cell.z + 2, kEnd); ++z) {
      for (int y = std::max(cell.y - 1, 0); y < std::min(cell.y + 2, kEnd); ++y) {
        for (int x = std::max(cell.x - 1, 0); x < std::min(cell.x + 2, kEnd); ++x) {
          const OctreeCell neighbour{x, y, z};
          if (!Same(neighbour, cell) && !visit(neighbour)) return;
        }
      }
    }
  }

  /// Of several leaves around an empty cell the first one takes it, so that none is sampled twice.
  [[nodiscard]] bool IsFirstLeafAround(const OctreeCell& empty,
                                       const OctreeCell& leaf) const noexcept {
    bool is_first = false;
    ForEachNeighbour(empty, [&](const OctreeCell& neighbour) {
      if (!HasLeaf(neighbour)) return true;
      is_first = Same(neighbour, leaf);
      return false;
    });
    return is_first;
  }

  void ExtractCell(const OctreeCell& cell) noexcept {
    cell_ = cell;
    const Vec3 low_m = PositionOf({0, 0, 0});
    const Vec3 high_m = PositionOf({steps_, steps_, steps_});
    // A vertex may be this far from the corners of its cube.
    const float reach_m = support_m_ + kCubeDiagonal * step_m_ * (1.0F + kRounding);
    surface_.Gather(low_m, high_m, reach_m);
    if (!surface_.HasSampleNear(low_m, high_m, support_m_)) return;
    ++counts_.cells;
    for (CachedVertex& cached : workspace_.vertices) cached.key = kNoKey;
    ForEachCorner(steps_ + 1, [this](const Corner& corner) {
      const LocalValue value = surface_.Evaluate(PositionOf(corner));
      DistanceAt(corner) = value.found ? value.distance_m : std::numeric_limits<float>::quiet_NaN();
    });
    ForEachCorner(steps_, [this](const Corner& corner) { ExtractCube(corner); });
  }

  template <class Visitor>
  static void ForEachCorner(int count, Visitor&& visit) noexcept {
    for (int z = 0; z < count; ++z) {
      for (int y = 0; y < count; ++y) {
        for (int x = 0; x < count; ++x) visit(Corner{x, y, z});
      }
    }
  }

  void ExtractCube(const Corner& origin) noexcept {
    unsigned inside = 0;
    for (unsigned i = 0; i < 8; ++i) {
      const float distance_m = DistanceAt(Shifted(origin, i));
      if (std::isnan(distance_m)) return;
      if (distance_m < 0.0F) inside |= 1U << i;
    }
    MarchTetrahedra(inside, [&](CubeEdge a, CubeEdge b, CubeEdge c) {
      const CachedVertex vertex_a = VertexOn(origin, a);
      const CachedVertex vertex_b = VertexOn(origin, b);
      const CachedVertex vertex_c = VertexOn(origin, c);
      if (!vertex_a.supported || !vertex_b.supported || !vertex_c.supported) return;
      ++counts_.triangles;
      sink_.OnTriangle(vertex_a.vertex, vertex_b.vertex, vertex_c.vertex);
    });
  }

  /// The vertex on an edge of a cube. Whoever asks for it gets the same bits, cached or not.
  [[nodiscard]] CachedVertex VertexOn(const Corner& origin, CubeEdge edge) noexcept {
    const Corner low = Shifted(origin, edge.low);
    const Corner high = Shifted(origin, edge.high);
    const std::uint32_t key = static_cast<std::uint32_t>(IndexOf(low) * 8U) + edge.high - edge.low;
    CachedVertex& cached = workspace_.vertices[key % workspace_.vertices.size()];
    if (cached.key != key) cached = MakeVertex(key, low, high);
    return cached;
  }

  [[nodiscard]] CachedVertex MakeVertex(std::uint32_t key, const Corner& low,
                                        const Corner& high) noexcept {
    constexpr int kMaxSteps = 4;
    const float tolerance_m = 0.002F * step_m_;
    const Vec3 start_m = PositionOf(low);
    const Vec3 along_m = PositionOf(high) - start_m;
    const bool inside_at_start = DistanceAt(low) < 0.0F;
    float first = 0.0F;  // The zero lies between these shares of the edge.
    float last = 1.0F;
    float share = DistanceAt(low) / (DistanceAt(low) - DistanceAt(high));
    LocalValue value;
    Vec3 x_m = start_m;
    for (int step = 0; step < kMaxSteps; ++step) {
      share = std::clamp(share, kEdgeMargin, 1.0F - kEdgeMargin);
      x_m = start_m + share * along_m;
      value = surface_.Evaluate(x_m);
      if (!value.found || std::abs(value.distance_m) < tolerance_m) break;
      ((value.distance_m < 0.0F) == inside_at_start ? first : last) = share;
      // Newton along the edge; bisection where the field is too bent for it.
      const float next = share - value.distance_m / value.gradient.dot(along_m);
      share = next > first && next < last ? next : 0.5F * (first + last);
    }
    // Where the field jumps instead of passing through zero there is no surface.
    const bool supported =
        value.found && value.nearest_m <= support_m_ &&
        std::abs(value.distance_m) < kLargestJump * (step_m_ + field_.config().merge_radius_m);
    if (!supported) return {key, false, {}};
    return {
        key,
        true,
        {x_m, value.gradient, std::sqrt(variance_.OfSurface(value.cluster, x_m, value.nearest_m))}};
  }

  [[nodiscard]] static Corner Shifted(const Corner& corner, unsigned bits) noexcept {
    return {corner.x + static_cast<int>(bits & 1U), corner.y + static_cast<int>(bits >> 1 & 1U),
            corner.z + static_cast<int>(bits >> 2)};
  }
  [[nodiscard]] static std::size_t IndexOf(const Corner& corner) noexcept {
    return static_cast<std::size_t>(
        (corner.z * Workspace::kCornersPerEdge + corner.y) * Workspace::kCornersPerEdge + corner.x);
  }
  [[nodiscard]] float& DistanceAt(const Corner& corner) noexcept {
    return workspace_.distance_m[IndexOf(corner)];
  }

  /// The same bits for a corner that several cells share.
  [[nodiscard]] Vec3 PositionOf(const Corner& corner) const noexcept {
    constexpr int kHalf = DistanceField<Limits>::Store::Tree::kCellsPerEdge / 2;
    const auto coordinate_m = [this](int cell, int place) {
      return static_cast<float>((cell - kHalf) * steps_ + place) * step_m_;
    };
    return {coordinate_m(cell_.x, corner.x), coordinate_m(cell_.y, corner.y),
            coordinate_m(cell_.z, corner.z)};
  }

  static constexpr std::uint32_t kNoKey = 0xFFFFFFFFU;
  /// Local GPs disagree by less than this share of the distances between corners and samples.
  static constexpr float kLargestJump = 0.1F;

  const DistanceField<Limits>& field_;
  Workspace& workspace_;
  TriangleSink& sink_;
  LocalSurface<Limits> surface_;
  PosteriorVariance<Limits> variance_;
  int steps_;
  float step_m_;
  float support_m_;
  OctreeCell cell_;
  SurfaceCounts counts_;
};

template <CapacityProfile Limits>
Expected<SurfaceCounts> ExtractSurface(const DistanceField<Limits>& field,
                                       const SurfaceOptions& options,
                                       SurfaceWorkspace<Limits>& workspace,
                                       TriangleSink& sink) noexcept {
  using Extractor = SurfaceExtractor<Limits>;
  if (field.empty()) return {{}, Status::kNotInitialised};
  if (!Extractor::IsValid(field, options)) return {{}, Status::kInvalidConfig};
  return {Extractor(field, options, workspace, sink).Run(), Status::kOk};
}

}  // namespace disflow
