// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/mesh_picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "disflow/host/depth_renderer.h"

namespace disflow::host {
namespace {

constexpr int kSamplesPerPixel = 2;  // per direction; their mean smooths the edges
constexpr double kViewAngle_rad = 0.6;
constexpr Rgb kBackColor{150, 150, 150};

/// The mesh about the origin, and every triangle once more, turned round: so both sides are drawn.
TriangleMesh MakeTwoSided(const TriangleMesh& mesh) {
  TriangleMesh both = mesh;
  MoveCentreToOrigin(both);
  both.triangles.reserve(2 * mesh.triangles.size());
  for (const TriangleMesh::Triangle& t : mesh.triangles)
    both.triangles.push_back({t[0], t[2], t[1]});
  return both;
}

/// Mean of the adjoining triangles' normals, weighted by area.
std::vector<Vec3d> VertexNormals(const TriangleMesh& mesh) {
  std::vector<Vec3d> normals(mesh.vertices.size(), Vec3d::Zero());
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    const Vec3d& a = mesh.vertices[t[0]];
    const Vec3d normal = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    for (const std::uint32_t corner : t) normals[corner] += normal;
  }
  return normals;
}

/// Weights of a triangle's corners at a point in its plane.
Vec3d Barycentric(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& x) {
  const Vec3d normal = (b - a).cross(c - a);
  const double square = normal.squaredNorm();
  const double weight_b = (x - a).cross(c - a).dot(normal) / square;
  const double weight_c = (b - a).cross(x - a).dot(normal) / square;
  return {1.0 - weight_b - weight_c, weight_b, weight_c};
}

/// Colours the points that a renderer found.
class Shader {
 public:
  Shader(const TriangleMesh& mesh, const std::vector<Rgb>& colors)
      : mesh_(mesh), colors_(colors), normals_(VertexNormals(mesh)) {}

  /// @param triangle Index into both(); beyond the mesh's own triangles it is a back side.
  [[nodiscard]] Vec3d ColorAt(std::size_t triangle, const TriangleMesh& both, const Vec3d& x_m,
                              const Mat3d& R_cm) const {
    const std::size_t front_triangles = mesh_.triangles.size();
    const TriangleMesh::Triangle& t = mesh_.triangles[triangle % front_triangles];
    const Vec3d weights =
        Barycentric(both.vertices[t[0]], both.vertices[t[1]], both.vertices[t[2]], x_m);
    Vec3d normal = Vec3d::Zero();
    Vec3d color = Vec3d::Zero();
    for (int i = 0; i < 3; ++i) {
      const std::size_t corner = t[static_cast<std::size_t>(i)];
      normal += weights[i] * normals_[corner];
      color += weights[i] * ToVector(colors_[corner]);
    }
    if (triangle >= front_triangles) {
      normal = -normal;
      color = ToVector(kBackColor);
    }
    const Vec3d towards_light = Vec3d(-0.4, -0.6, -0.8).normalized();  // camera axes
    constexpr double kAmbient = 0.35;
    const double lambert = std::max(0.0, (R_cm * normal.normalized()).dot(towards_light));
    return color * (kAmbient + (1.0 - kAmbient) * lambert);
  }

 private:
  static Vec3d ToVector(const Rgb& color) {
    return {double(color[0]), double(color[1]), double(color[2])};
  }

  const TriangleMesh& mesh_;
  const std::vector<Rgb>& colors_;
  std::vector<Vec3d> normals_;
};

/// Replaces each square of samples by its mean.
std::vector<std::uint8_t> Shrink(const std::vector<Vec3d>& samples, int width_px, int height_px) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 3);
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      Vec3d sum = Vec3d::Zero();
      for (int i = 0; i < kSamplesPerPixel * kSamplesPerPixel; ++i) {
        const int row = kSamplesPerPixel * v + i / kSamplesPerPixel;
        const int column = kSamplesPerPixel * u + i % kSamplesPerPixel;
        sum += samples[static_cast<std::size_t>(row * kSamplesPerPixel * width_px + column)];
      }
      for (int i = 0; i < 3; ++i) {
        const double mean = sum[i] / (kSamplesPerPixel * kSamplesPerPixel);
        pixels.push_back(static_cast<std::uint8_t>(std::clamp(mean, 0.0, 255.0)));
      }
    }
  }
  return pixels;
}

}  // namespace

std::vector<std::uint8_t> RenderMesh(const TriangleMesh& mesh,
                                     const std::vector<Rgb>& vertex_colors, const MeshView& view) {
  assert(vertex_colors.size() == mesh.vertices.size());
  const int width = kSamplesPerPixel * view.width_px;
  const int height = kSamplesPerPixel * view.height_px;
  std::vector<Vec3d> samples(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                             Vec3d::Constant(255.0));
  if (mesh.triangles.empty()) return Shrink(samples, view.width_px, view.height_px);

  const TriangleMesh both = MakeTwoSided(mesh);
  const double smaller = std::min(width, height);
  const auto focal = static_cast<float>(0.5 * smaller / std::tan(0.5 * kViewAngle_rad));
  const PinholeCamera camera{focal, focal, 0.5F * static_cast<float>(width - 1),
                             0.5F * static_cast<float>(height - 1)};
  const Mat3d R_cm =
      ExpSo3(Vec3d(view.elevation_rad, 0.0, 0.0)) * ExpSo3(Vec3d(0.0, view.azimuth_rad, 0.0));
  constexpr double kBorder = 1.03;
  const double distance_m = kBorder * BoundingRadius(both) / std::sin(0.5 * kViewAngle_rad);
  const Transform<Camera, Object, double> T_cm(R_cm, Vec3d(0.0, 0.0, distance_m));
  DepthRenderer renderer(camera, width, height);
  renderer.DrawTriangles(both, T_cm);

  const Shader shader(mesh, vertex_colors);
  const Transform<Object, Camera, double> T_mc = T_cm.Inverse();
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const auto pixel = static_cast<std::size_t>(v * width + u);
      if (renderer.labels()[pixel] == 0) continue;
      const double depth_m = 1.0 / static_cast<double>(renderer.inverse_depth_per_m()[pixel]);
      const Vec3d ray = camera.Ray(static_cast<float>(u), static_cast<float>(v)).cast<double>();
      samples[pixel] =
          shader.ColorAt(renderer.labels()[pixel] - 1, both, T_mc * Vec3d(depth_m * ray), R_cm);
    }
  }
  return Shrink(samples, view.width_px, view.height_px);
}

}  // namespace disflow::host
