// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "disflow/config.h"
#include "disflow/depth/surface_sample.h"
#include "disflow/field/edge_index.h"
#include "disflow/field/edge_map.h"
#include "disflow/flow/residual.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// The residual of an occluding edge against an edge of the model, object frame. The outline in the
/// image moves only across the ray and across the edge, which is the gradient's direction.
/// @param moved The observed edge in the object frame.
/// @param radius_m Of the object's rounded edges.
/// @return Unmatched when the edge points at the camera.
[[nodiscard]] Residual EdgeResidualOf(const EdgePoint& moved, const ModelEdge& edge,
                                      float radius_m) noexcept;

/// Residuals of a frame's occluding edges: their distance from the model's edges as the image shows
/// it. An addition to the paper; they hold the pose along flat faces. A kind of residual as
/// residual.h wants it.
template <class Limits>
class EdgeResiduals {
 public:
  using Model = EdgeMap<Limits::kMaxModelEdges>;
  using Edges = FixedVector<EdgePoint, Limits::kMaxEdgePoints>;
  using Index = EdgeIndex<Limits::kMaxModelEdges>;

  /// Keeps references to its arguments.
  /// @param edges Camera frame.
  /// @param index Memory for that of the model.
  /// @param known_only Without what was found while the object may have slid.
  EdgeResiduals(const Model& model, const Edges& edges, const RegistrationConfig& config,
                Index& index, bool known_only = false) noexcept
      : model_(model),
        edges_(edges),
        config_(config),
        index_(index),
        radius_m_(known_rounding().radius_m) {
    index_.Build(known_only ? model.known() : model.all());
  }

  [[nodiscard]] int size() const noexcept { return edges_.size(); }
  /// What was known of the edges' rounding before this frame.
  [[nodiscard]] const EdgeRounding& known_rounding() const noexcept { return model_.rounding(); }
  /// The radius that the residuals are for.
  [[nodiscard]] float radius_m() const noexcept { return radius_m_; }
  void SetRadius(float radius_m) noexcept { radius_m_ = radius_m; }

  [[nodiscard]] Residual At(int i, const PoseObjectFromCamera& T_oc, float scale_m,
                            Matching matching) noexcept {
    const ModelEdge*& known = known_[static_cast<std::size_t>(i)];
    Residual residual;
    // One edge is easily taken for another before the first step.
    const bool search = matching != Matching::kLinear;
    if (search || known != nullptr) {
      const EdgePoint moved = T_oc * edges_[i];
      if (search) known = index_.FindNearest(moved, config_.match_radius_m + scale_m);
      if (known != nullptr) residual = EdgeResidualOf(moved, *known, radius_m_);
    }
    const bool unmatched = residual.status == ResidualStatus::kUnmatched;
    if (unmatched && !edges_[i].steady) residual.status = ResidualStatus::kUnexpected;
    return residual;
  }

  /// A residual as it would be if its edge ran across itself in the image: what errors of the
  /// direction let it tell in part.
  [[nodiscard]] Residual Along(int i, const PoseObjectFromCamera& T_oc,
                               Residual residual) const noexcept {
    residual.gradient = residual.gradient.cross(T_oc.rotation() * edges_[i].ray);
    return residual;
  }
  /// A residual as it would be if its edge lay at the origin, but for what it may lie behind
  /// where it was taken for.
  [[nodiscard]] Residual Behind(int i, const PoseObjectFromCamera& T_oc,
                                Residual residual) const noexcept {
    residual.point_m = edges_[i].bend_m * (T_oc.rotation() * edges_[i].ray);
    return residual;
  }

 private:
  const Model& model_;
  const Edges& edges_;
  const RegistrationConfig& config_;
  Index& index_;
  float radius_m_;
  /// What an edge was matched with; written by the first search.
  std::array<const ModelEdge*, static_cast<std::size_t>(Limits::kMaxEdgePoints)> known_{};
};

}  // namespace disflow
