// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/depth_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

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
  std::fill(labels_.begin(), labels_.end(), std::uint8_t{0});
}

void DepthRenderer::DrawPlane(const Plane& plane) {
  const Vec3d n = plane.normal / plane.offset_m;  // n . ray = 1/z
  std::size_t pixel = 0;
  for (int v = 0; v < height_; ++v) {
    const auto start = static_cast<float>(n.z() + n.y() * (v - cy_) / fy_ - n.x() * cx_ / fx_);
    const auto step = static_cast<float>(n.x() / fx_);
    for (int u = 0; u < width_; ++u, ++pixel) {
      const float inverse_depth = start + step * static_cast<float>(u);
      if (inverse_depth <= inverse_depth_[pixel]) continue;
      inverse_depth_[pixel] = inverse_depth;
      labels_[pixel] = 0;
    }
  }
}

void DepthRenderer::DrawMesh(const TriangleMesh& mesh,
                             const Transform<Camera, Object, double>& T_cm, std::uint8_t label) {
  projected_.resize(std::max(projected_.size(), mesh.vertices.size()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3d x = T_cm * mesh.vertices[i];
    projected_[i] = {x, fx_ * x.x() / x.z() + cx_, fy_ * x.y() / x.z() + cy_};
  }
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    DrawTriangle(projected_[t[0]], projected_[t[1]], projected_[t[2]], label);
  }
}

void DepthRenderer::DrawTriangle(const ProjectedVertex& a, const ProjectedVertex& b,
                                 const ProjectedVertex& c, std::uint8_t label) {
  const double nearest_m = std::min({a.position_m.z(), b.position_m.z(), c.position_m.z()});
  if (!(nearest_m > kNearLimit_m)) return;
  const int u_min = static_cast<int>(std::ceil(std::max(0.0, std::min({a.u_px, b.u_px, c.u_px}))));
  const int v_min = static_cast<int>(std::ceil(std::max(0.0, std::min({a.v_px, b.v_px, c.v_px}))));
  const int u_max = static_cast<int>(
      std::floor(std::min<double>(width_ - 1, std::max({a.u_px, b.u_px, c.u_px}))));
  const int v_max = static_cast<int>(
      std::floor(std::min<double>(height_ - 1, std::max({a.v_px, b.v_px, c.v_px}))));
  if (u_min > u_max || v_min > v_max) return;  // covers no pixel centre
  const Vec3d normal = (b.position_m - a.position_m).cross(c.position_m - a.position_m);
  const double offset = normal.dot(a.position_m);
  if (!(offset < 0.0)) return;  // seen from behind or edge-on
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
