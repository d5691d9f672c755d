// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "disflow/field/distance_field.h"
#include "disflow/limits.h"
#include "disflow/status.h"
#include "disflow/types.h"

/// @file
/// The model's surface as a stream of triangles or of samples. No mesh is ever held.

namespace disflow {

struct SurfaceVertex {
  Vec3 position_m = Vec3::Zero();  ///< Object frame.
  Vec3 normal = Vec3::Zero();      ///< Unit length, outward.
  float std_m = 0.0F;              ///< How far off the surface may be along its normal; one sigma.
};

/// Receives triangles one by one; nothing is stored by the extractor.
class TriangleSink {
 public:
  TriangleSink(const TriangleSink&) = delete;
  TriangleSink& operator=(const TriangleSink&) = delete;
  /// Counter-clockwise seen from outside. A vertex shared by several triangles comes with each, bit
  /// by bit the same.
  void OnTriangle(const SurfaceVertex& a, const SurfaceVertex& b, const SurfaceVertex& c) noexcept {
    DoOnTriangle(a, b, c);
  }

 protected:
  TriangleSink() = default;
  ~TriangleSink() = default;

 private:
  virtual void DoOnTriangle(const SurfaceVertex& a, const SurfaceVertex& b,
                            const SurfaceVertex& c) noexcept = 0;
};

struct SurfaceOptions {
  /// Edge of a sampling cube at most; the octree's cells are divided evenly. Not finer than a
  /// cell's sixteenth; a field that is coarser than set (FieldConfig::fit_to_object) is drawn no
  /// finer than that.
  float resolution_m = 0.0025F;
  /// Surface farther than this (and than one octree cell) from every observed sample is left open;
  /// as much farther as the field is coarser than set.
  float support_radius_m = 0.008F;
  /// Samples of the model that were observed less often are left out.
  int min_observations = 1;
};

struct SurfaceCounts {
  int cells = 0;      ///< Octree cells sampled.
  int triangles = 0;  ///< Triangles given to the sink.
};

/// An octree cell is cut into at most this many sampling cubes along each edge.
inline constexpr int kMaxStepsPerCell = 16;

/// Scratch memory of ExtractSurface(): the distances on one octree cell's grid, and vertices that
/// several triangles share.
template <CapacityProfile Limits>
struct SurfaceWorkspace {
  static constexpr int kCornersPerEdge = kMaxStepsPerCell + 1;
  static constexpr int kCachedVertices = 512;

  struct CachedVertex {
    std::uint32_t key;  ///< Which edge of which cube of the cell.
    bool supported;
    SurfaceVertex vertex;
  };

  std::array<float, static_cast<std::size_t>(kCornersPerEdge* kCornersPerEdge* kCornersPerEdge)>
      distance_m;
  std::array<CachedVertex, static_cast<std::size_t>(kCachedVertices)> vertices;
  GpWorkspace<Limits::kMaxTrainingSamples> gp;
};

/// Streams the zero level of the distance field: marching tetrahedra in every octree cell that
/// holds samples, and in those next to them. Neighbouring cells agree on their common corners, so
/// that the surface is closed wherever it was seen and open elsewhere.
/// @return kNotInitialised for an empty model, kInvalidConfig if an option is not positive and
/// finite or if the resolution is finer than a cell's sixteenth; the sink is then not called.
template <CapacityProfile Limits>
[[nodiscard]] Expected<SurfaceCounts> ExtractSurface(const DistanceField<Limits>& field,
                                                     const SurfaceOptions& options,
                                                     SurfaceWorkspace<Limits>& workspace,
                                                     TriangleSink& sink) noexcept;

/// Receives the samples of the model one by one.
class SampleSink {
 public:
  SampleSink(const SampleSink&) = delete;
  SampleSink& operator=(const SampleSink&) = delete;
  /// @param sample std_m is that of the sample's position along its normal.
  /// @param observations How many observations were averaged.
  void OnSample(const SurfaceVertex& sample, int observations) noexcept {
    DoOnSample(sample, observations);
  }

 protected:
  SampleSink() = default;
  ~SampleSink() = default;

 private:
  virtual void DoOnSample(const SurfaceVertex& sample, int observations) noexcept = 0;
};

/// Streams the samples that the model is made of, in a fixed order. @return How many.
template <class Limits>
int StreamSamples(const DistanceField<Limits>& field, SampleSink& sink) noexcept {
  int count = 0;
  field.store().ForEach([&](Handle, const auto& cluster) {
    for (const ModelSample& sample : cluster.samples) {
      sink.OnSample({sample.position_m, sample.normal, std::sqrt(sample.variance_m2)},
                    sample.observations);
      ++count;
    }
  });
  return count;
}

extern template Expected<SurfaceCounts> ExtractSurface(const DistanceField<profiles::Micro>&,
                                                       const SurfaceOptions&,
                                                       SurfaceWorkspace<profiles::Micro>&,
                                                       TriangleSink&) noexcept;
extern template Expected<SurfaceCounts> ExtractSurface(const DistanceField<profiles::Edge>&,
                                                       const SurfaceOptions&,
                                                       SurfaceWorkspace<profiles::Edge>&,
                                                       TriangleSink&) noexcept;
extern template Expected<SurfaceCounts> ExtractSurface(const DistanceField<profiles::Dense>&,
                                                       const SurfaceOptions&,
                                                       SurfaceWorkspace<profiles::Dense>&,
                                                       TriangleSink&) noexcept;

}  // namespace disflow
