// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "point_index.h"
#include "surface.h"

namespace disflow::apps {

/// Finds the point of a surface that is nearest to another point.
class NearestSurface {
 public:
  /// The nearest point and what is known about it.
  struct Hit {
    SurfacePoint point;
    double distance = 0.0;
    std::uint32_t sample = 0;  ///< Number of the nearest sample.
  };

  /// @param surface Must outlive this, unchanged.
  /// @param samples Points spread over it; not empty.
  NearestSurface(const Surface& surface, std::vector<SurfacePoint> samples);

  [[nodiscard]] const std::vector<SurfacePoint>& samples() const { return samples_; }

  /// On a mesh: the nearest point of the triangles with an anchor nearby, so the result is not
  /// limited by the spacing of the samples. On a cloud: its nearest point.
  [[nodiscard]] Hit Find(const Vec3d& query) const;

 private:
  const Surface& surface_;
  std::vector<SurfacePoint> samples_;
  std::vector<Vec3d> sample_positions_;
  PointIndex sample_index_;
  // The samples, and the centre of every triangle that is too small to have got one.
  std::vector<SurfacePoint> anchors_;
  std::vector<Vec3d> anchor_positions_;
  PointIndex anchor_index_;
};

}  // namespace disflow::apps
