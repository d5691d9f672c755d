// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "disflow/geometry/pinhole_camera.h"
#include "disflow/host/triangle_mesh.h"

namespace disflow::host {

/// Plane n . x = d in the camera frame.
struct Plane {
  Vec3d normal = Vec3d::UnitZ();
  double offset_m = 1.0;
};

/// Draws planes and meshes into an image of inverse depth. 1/z is affine in the pixel coordinates
/// on every plane, so the depth at a pixel's centre is exact up to float rounding.
class DepthRenderer {
 public:
  /// Allocates the image; drawing allocates only when a mesh has more vertices than any before.
  DepthRenderer(const PinholeCamera& camera, int width_px, int height_px);

  void Clear();
  /// The part of an unbounded plane that lies in front of the camera.
  void DrawPlane(const Plane& plane, std::uint32_t label = 0);
  /// Triangles seen from outside; those that reach behind the near limit are left out.
  /// @param T_cm Mesh in the camera frame.
  void DrawMesh(const TriangleMesh& mesh, const Transform<Camera, Object, double>& T_cm,
                std::uint32_t label);
  /// The same with a label of its own for each triangle: its index in the mesh plus one.
  void DrawTriangles(const TriangleMesh& mesh, const Transform<Camera, Object, double>& T_cm);

  /// 1/z [1/m] row-major; 0 where nothing was drawn.
  [[nodiscard]] std::span<const float> inverse_depth_per_m() const { return inverse_depth_; }
  /// What is seen in each pixel.
  [[nodiscard]] std::span<const std::uint32_t> labels() const { return labels_; }
  [[nodiscard]] int width_px() const { return width_; }
  [[nodiscard]] int height_px() const { return height_; }

  static constexpr double kNearLimit_m = 0.02;

 private:
  struct ProjectedVertex {
    Vec3d position_m;  // camera frame
    double u_px;
    double v_px;
  };
  void Project(const TriangleMesh& mesh, const Transform<Camera, Object, double>& T_cm);
  void DrawTriangle(const ProjectedVertex& a, const ProjectedVertex& b, const ProjectedVertex& c,
                    std::uint32_t label);

  int width_;
  int height_;
  double fx_, fy_, cx_, cy_;
  std::vector<float> inverse_depth_;
  std::vector<std::uint32_t> labels_;
  std::vector<ProjectedVertex> projected_;
};

}  // namespace disflow::host
