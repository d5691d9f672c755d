// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/field/distance_query.h"
#include "disflow/surface_extractor.h"
#include "disflow/tracker.h"

namespace disflow::apps {

/// How a model's surface is drawn.
/// @param resolution_m 0: finer than the model's own detail is waste, coarser loses it.
[[nodiscard]] inline SurfaceOptions DrawingOptions(const FieldConfig& field,
                                                   float resolution_m) noexcept {
  constexpr float kStepsPerCell = 10.0F;
  // Fused samples lie about a merge radius apart; what is much farther from all of them is open.
  constexpr float kSupportInMergeRadii = 1.6F;
  SurfaceOptions surface;
  surface.resolution_m = resolution_m > 0.0F ? resolution_m : field.cell_size_m / kStepsPerCell;
  surface.support_radius_m = kSupportInMergeRadii * field.merge_radius_m;
  return surface;
}

/// Asks a model for distances and draws it, both with the same idea of where surface is known.
/// Holds the memory that this needs; not for two threads at once.
template <class Limits>
class ModelReader {
 public:
  using Field = typename Tracker<Limits>::Field;

  /// At a point of the object frame; see DistanceQuerier.
  [[nodiscard]] Expected<DistanceQuery> Query(const Field& field, const FieldConfig& config,
                                              const Vec3& x_m) noexcept {
    const float support_radius_m = DrawingOptions(config, 0.0F).support_radius_m;
    return DistanceQuerier<Limits>(field, workspace_.gp, support_radius_m).Query(x_m);
  }
  /// See disflow::ExtractSurface().
  /// @param resolution_m 0: as fine as the model's own detail.
  [[nodiscard]] Expected<SurfaceCounts> Extract(const Field& field, const FieldConfig& config,
                                                float resolution_m, TriangleSink& sink) noexcept {
    return ExtractSurface(field, DrawingOptions(config, resolution_m), workspace_, sink);
  }

 private:
  SurfaceWorkspace<Limits> workspace_;
};

}  // namespace disflow::apps
