// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "disflow/depth/surface_sample.h"
#include "disflow/estimate.h"
#include "disflow/field/edge_rounding.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// An edge of the model: what is known from the occluding-edge points seen on it. A view knows the
/// place across its ray to a part of a pixel, along the ray only as well as the depth beside the
/// edge. Object frame.
struct ModelEdge {
  Vec3 position_m;           ///< Where the points were seen, as if the edge were sharp.
  Vec3 position_per_radius;  ///< What a radius of rounding has added to that, per its length.
  Vec3 direction;
  Vec3 normal;                  ///< Of the face that ended here when it was first seen.
  std::uint32_t last_seen;      ///< Number of the frame.
  float weight;                 ///< Observations, bounded so that an edge can still move.
  Mat<float, 2, 2> covariance;  ///< Of the position along the columns of Across() [m^2].

  /// Two unit vectors across the edge.
  [[nodiscard]] Mat<float, 3, 2> Across() const noexcept;
  /// Variance of the position along a unit vector across the edge [m^2].
  [[nodiscard]] float VarianceAlong(const Vec3& unit) const noexcept;
};

/// The edge that a first point makes.
[[nodiscard]] ModelEdge MakeModelEdge(const EdgePoint& point, std::uint32_t frame) noexcept;

/// Whether a point may show an edge: by direction, faces, and how well the edge is known. An edge
/// is where two faces meet, and is the outline of either when the other has turned away: what one
/// was built with holds the other. Directions are compared as the image shows them: how an edge
/// runs in depth a noisy sensor hardly sees.
[[nodiscard]] bool IsSeenAs(const ModelEdge& edge, const EdgePoint& point) noexcept;

/// The nearest edge that a point may show, within radius_m.
/// @return Its index, or -1.
[[nodiscard]] int FindNearestEdge(std::span<const ModelEdge> edges, const EdgePoint& point,
                                  float radius_m) noexcept;

/// Observations after which an edge forgets as much as it learns.
inline constexpr float kMaxEdgeWeight = 20.0F;

/// Observations after which an edge, known to a third of a point's error, is found by points that
/// are not steady. Outlines of round things make edges by chance, but seldom as often in one place.
inline constexpr float kWellKnownWeight = 8.0F;

/// Fuses a point into an edge.
void MergeIntoEdge(const EdgePoint& point, std::uint32_t frame, ModelEdge& edge) noexcept;

/// How far a point may be from the edge that it is a point of, given how well its depth is known.
[[nodiscard]] float MergeRadius(const EdgePoint& point, float merge_radius_m) noexcept;

/// Which edge makes room for a new one: of those seen once or twice, or else of all, the one that
/// was not seen for the longest time.
/// @param frame The present one; what was seen in it stays.
/// @return Its index, or -1.
[[nodiscard]] int FindForgettable(std::span<const ModelEdge> edges, std::uint32_t frame) noexcept;

/// The object's sharp edges. Object frame.
template <int kMaxEdges>
class EdgeMap {
 public:
  using Edge = ModelEdge;

  void Start() noexcept {
    edges_.clear();
    rounding_ = {};
    shift_free_ = false;
  }
  [[nodiscard]] int size() const noexcept { return edges_.size(); }

  [[nodiscard]] const EdgeRounding& rounding() const noexcept { return rounding_; }
  void SetRounding(const EdgeRounding& rounding) noexcept { rounding_ = rounding; }

  [[nodiscard]] std::span<const Edge> all() const noexcept {
    return {edges_.begin(), edges_.end()};
  }

  /// Those that were not found while the object may have slid, see PlaceSlip.
  [[nodiscard]] std::span<const Edge> known() const noexcept {
    return all().first(static_cast<std::size_t>(known_count()));
  }
  /// Whether edges that are found from now on are found so. The known ones do not make room for
  /// them. False: what was found so is where it belongs.
  void SetShiftFree(bool shift_free) noexcept {
    if (shift_free && !shift_free_) known_count_ = edges_.size();
    shift_free_ = shift_free;
  }
  void ForgetFoundShiftFree() noexcept { edges_.truncate(known_count()); }

  /// Fuses a steady point into the edge near it, or stores it, if the map is full for another.
  /// @param frame Number of the frame, not decreasing.
  void Insert(const EdgePoint& point, float merge_radius_m, std::uint32_t frame,
              Counters& counters) noexcept {
    if (!point.steady) return;
    const int nearest = FindNearestEdge(all(), point, MergeRadius(point, merge_radius_m));
    if (nearest >= 0) {
      MergeIntoEdge(point, frame, edges_[nearest]);
      return;
    }
    const Edge edge = MakeModelEdge(point, frame);
    if (edges_.push_back(edge)) return;
    const int kept = shift_free_ ? known_count_ : 0;
    const int forgettable = FindForgettable(all().subspan(static_cast<std::size_t>(kept)), frame);
    if (forgettable < 0) {
      ++counters.edges_refused;
    } else {
      edges_[kept + forgettable] = edge;
    }
  }

 private:
  [[nodiscard]] int known_count() const noexcept {
    return shift_free_ ? known_count_ : edges_.size();
  }

  FixedVector<Edge, kMaxEdges> edges_;
  bool shift_free_ = false;
  int known_count_ = 0;  ///< How many there were when it began.
  EdgeRounding rounding_;
};

}  // namespace disflow
