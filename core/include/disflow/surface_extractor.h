// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/types.h"

namespace disflow {

struct SurfaceVertex {
  Vec3 position_m = Vec3::Zero();  ///< Object frame.
  Vec3 normal = Vec3::Zero();      ///< Unit length, outward.
  float std_m = 0.0F;              ///< Posterior standard deviation of the distance field here.
};

/// Receives triangles one by one; nothing is stored by the extractor.
class TriangleSink {
 public:
  TriangleSink(const TriangleSink&) = delete;
  TriangleSink& operator=(const TriangleSink&) = delete;
  /// Counter-clockwise seen from outside.
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
  float resolution_m = 0.0025F;  ///< Edge of a sampling cube.
  float support_radius_m =
      0.008F;  ///< Surface farther than this from every observed sample is left open.
};

}  // namespace disflow
