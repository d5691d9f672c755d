// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/depth_renderer.h"

#include <algorithm>
#include <array>

namespace disflow::host {
namespace {

/// Value that is affine in the pixel coordinates.
struct Affine {
  double per_u;
  double per_v;
  double at_origin;

  [[nodiscard]] double At(double u, double v) const { return per_u * u + per_v * v + at_origin; }
};

/// Positive on the left of the line from (u0, v0) to (u1, v1) when v points down.
Affine EdgeFunction(double u0, double v0, double u1, double v1) {
  return {v1 - v0, u0 - u1, u1 * v0 - u0 * v1};
}

// Conversions to int instead of std::ceil and std::floor, which are calls on plain x86-64.

/// The first pixel centre of the image at or after a coordinate.
int FirstPixel(double coordinate_px) {
  if (!(coordinate_px > 0.0)) return 0;
  constexpr double kFarOutside_px = 1e6;
  const int whole = static_cast<int>(std::min(coordinate_px, kFarOutside_px));
  return static_cast<double>(whole) < coordinate_px ? whole + 1 : whole;
}

/// The last pixel centre of the image at or before a coordinate; -1 if there is none.
int LastPixel(double coordinate_px, int size_px) {
  if (!(coordinate_px >= 0.0)) return -1;
  return static_cast<int>(std::min(coordinate_px, static_cast<double>(size_px - 1)));
}

}  // namespace

DepthRenderer::DepthRenderer(const PinholeCamera& camera, int width_px, int height_px)
    : width_(width_px),
      height_(height_px),
      fx_(static_cast<double>(camera.fx_px)),
      fy_(static_cast<double>(camera.fy_px)),
      cx_(static_cast<double>(camera.cx_px)),
      cy_(static_cast<double>(camera.cy_px)),
      inverse_depth_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
      labels_(inverse_depth_.size()) {}

void DepthRenderer::Clear() {
  std::fill(inverse_depth_.begin(), inverse_depth_.end(), 0.0F);
  std::fill(labels_.begin(), labels_.end(), std::uint32_t{0});
}

void DepthRenderer::DrawPlane(const Plane& plane, std::uint32_t label) {
  const Vec3d n = plane.normal / plane.offset_m;  // n . ray = 1/z
  std::size_t pixel = 0;
  for (int v = 0; v < height_; ++v) {
    const auto start = static_cast<float>(n.z() + n.y() * (v - cy_) / fy_ - n.x() * cx_ / fx_);
    const auto step = static_cast<float>(n.x() / fx_);
    for (int u = 0; u < width_; ++u, ++pixel) {
      const float inverse_depth = start + step * static_cast<float>(u);
      if (inverse_depth <= inverse_depth_[pixel]) continue;
      inverse_depth_[pixel] = inverse_depth;
      labels_[pixel] = label;
    }
  }
}

void DepthRenderer::DrawMesh(const TriangleMesh& mesh,
                             const Transform<Camera, Object, double>& T_cm, std::uint32_t label) {
  Project(mesh, T_cm);
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    DrawTriangle(projected_[t[0]], projected_[t[1]], projected_[t[2]], label);
  }
}

void DepthRenderer::DrawTriangles(const TriangleMesh& mesh,
                                  const Transform<Camera, Object, double>& T_cm) {
  Project(mesh, T_cm);
  std::uint32_t label = 0;
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    DrawTriangle(projected_[t[0]], projected_[t[1]], projected_[t[2]], ++label);
  }
}

void DepthRenderer::Project(const TriangleMesh& mesh,
                            const Transform<Camera, Object, double>& T_cm) {
  projected_.resize(std::max(projected_.size(), mesh.vertices.size()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3d x = T_cm * mesh.vertices[i];
    projected_[i] = {x, fx_ * x.x() / x.z() + cx_, fy_ * x.y() / x.z() + cy_};
  }
}

void DepthRenderer::DrawTriangle(const ProjectedVertex& a, const ProjectedVertex& b,
                                 const ProjectedVertex& c, std::uint32_t label) {
  const double nearest_m = std::min({a.position_m.z(), b.position_m.z(), c.position_m.z()});
  if (!(nearest_m > kNearLimit_m)) return;
  // Most triangles of a dense mesh end here: seen from behind, or between pixel centres.
  if (!(EdgeFunction(a.u_px, a.v_px, b.u_px, b.v_px).At(c.u_px, c.v_px) > 0.0)) return;
  const int u_min = FirstPixel(std::min({a.u_px, b.u_px, c.u_px}));
  const int v_min = FirstPixel(std::min({a.v_px, b.v_px, c.v_px}));
  const int u_max = LastPixel(std::max({a.u_px, b.u_px, c.u_px}), width_);
  const int v_max = LastPixel(std::max({a.v_px, b.v_px, c.v_px}), height_);
  if (u_min > u_max || v_min > v_max) return;
  const Vec3d normal = (b.position_m - a.position_m).cross(c.position_m - a.position_m);
  const double offset = normal.dot(a.position_m);
  if (!(offset < 0.0)) return;  // edge-on
  const Vec3d n = normal / offset;
  const Affine inverse_depth{n.x() / fx_, n.y() / fy_,
                             n.z() - n.x() * cx_ / fx_ - n.y() * cy_ / fy_};
  const std::array<Affine, 3> edges{EdgeFunction(a.u_px, a.v_px, b.u_px, b.v_px),
                                    EdgeFunction(b.u_px, b.v_px, c.u_px, c.v_px),
                                    EdgeFunction(c.u_px, c.v_px, a.u_px, a.v_px)};
  // Pixel centres on an edge belong to both neighbours: a rounding error must not open a crack.
  constexpr double kEdgeTolerance = -1e-7;
  for (int v = v_min; v <= v_max; ++v) {
    const std::size_t row = static_cast<std::size_t>(v) * static_cast<std::size_t>(width_);
    for (int u = u_min; u <= u_max; ++u) {
      if (edges[0].At(u, v) < kEdgeTolerance || edges[1].At(u, v) < kEdgeTolerance ||
          edges[2].At(u, v) < kEdgeTolerance) {
        continue;
      }
      const auto value = static_cast<float>(inverse_depth.At(u, v));
      const std::size_t pixel = row + static_cast<std::size_t>(u);
      if (value <= inverse_depth_[pixel]) continue;
      inverse_depth_[pixel] = value;
      labels_[pixel] = label;
    }
  }
}

}  // namespace disflow::host
