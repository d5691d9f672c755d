// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/depth_renderer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "box_ray.h"
#include "disflow/host/object_meshes.h"

namespace disflow::host {
namespace {

constexpr int kWidth_px = 160;
constexpr int kHeight_px = 120;
constexpr PinholeCamera kCamera{150.0F, 140.0F, 81.5F, 58.25F};
constexpr std::uint32_t kLabel = 7;

using CameraFromMesh = Transform<Camera, Object, double>;

Vec3d Ray(int u, int v) {
  return kCamera.Ray(static_cast<float>(u), static_cast<float>(v)).cast<double>();
}

std::size_t Pixel(int u, int v) { return static_cast<std::size_t>(v * kWidth_px + u); }

/// Calls check(u, v, depth, label) for every pixel; depth is 0 where nothing was drawn.
template <class Check>
void ForEachPixel(const DepthRenderer& renderer, const Check& check) {
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      const auto w = static_cast<double>(renderer.inverse_depth_per_m()[Pixel(u, v)]);
      check(u, v, w > 0.0 ? 1.0 / w : 0.0, renderer.labels()[Pixel(u, v)]);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(DepthRenderer, Plane_HasTheDepthOfTheRay) {
  DepthRenderer renderer(kCamera, kWidth_px, kHeight_px);
  const Plane plane{Vec3d(0.3, -0.2, 0.9).normalized(), 1.3};
  renderer.DrawPlane(plane);
  ForEachPixel(renderer, [&](int u, int v, double depth_m, std::uint32_t) {
    ASSERT_NEAR(depth_m, plane.offset_m / plane.normal.dot(Ray(u, v)), 1e-6);
  });
}

TEST(DepthRenderer, PartOfAPlaneBehindTheCamera_IsNotDrawn) {
  DepthRenderer renderer(kCamera, kWidth_px, kHeight_px);
  const Plane table{Vec3d(0.0, 1.0, 0.0), 0.4};  // below; the horizon is at the image's middle
  renderer.DrawPlane(table);
  ForEachPixel(renderer, [&](int u, int v, double depth_m, std::uint32_t) {
    ASSERT_EQ(depth_m > 0.0, Ray(u, v).y() > 0.0) << u << " " << v;
  });
}

TEST(DepthRenderer, TurnedBox_HasDepthAndOutlineOfTheRays) {
  DepthRenderer renderer(kCamera, kWidth_px, kHeight_px);
  const CameraFromMesh T(ExpSo3(Vec3d(0.7, -0.5, 0.3)), Vec3d(0.03, -0.02, 0.45));
  renderer.DrawMesh(MakeCrackerBox(), T, kLabel);
  const Vec3d half(0.082, 0.036, 0.1065);
  int seen = 0;
  ForEachPixel(renderer, [&](int u, int v, double depth_m, std::uint32_t label) {
    const auto expected = BoxDepth(half, T, Ray(u, v));
    // Rays that graze the outline may fall on either side by rounding.
    const Vec3d sliver = Vec3d::Constant(1e-6);
    const bool certain = BoxDepth(half + sliver, T, Ray(u, v)).has_value() ==
                         BoxDepth(half - sliver, T, Ray(u, v)).has_value();
    if (!certain) return;
    ASSERT_EQ(label, expected ? kLabel : 0U) << u << " " << v;
    if (!expected) return;
    ASSERT_NEAR(depth_m, *expected, 1e-6);
    ++seen;
  });
  EXPECT_GT(seen, 2000);
}

TEST(DepthRenderer, Doughnut_LiesOnTheTorusAndHasNoCracks) {
  DepthRenderer renderer(kCamera, kWidth_px, kHeight_px);
  const CameraFromMesh T(ExpSo3(Vec3d(0.4, 0.2, 0.0)), Vec3d(0.0, 0.0, 0.3));
  renderer.DrawMesh(MakeDoughnut(), T, kLabel);
  const Transform<Object, Camera, double> T_inverse = T.Inverse();
  int seen = 0;
  ForEachPixel(renderer, [&](int u, int v, double depth_m, std::uint32_t label) {
    if (label != kLabel) return;
    ++seen;
    const Vec3d x = T_inverse * Vec3d(Ray(u, v) * depth_m);
    ASSERT_NEAR(std::hypot(std::hypot(x.x(), x.y()) - 0.040, x.z()), 0.020, 5e-5)
        << "a crack would show the far side";
    // The near side: the normal points to the camera.
    const double ring = 0.040 / std::hypot(x.x(), x.y());
    const Vec3d normal(x.x() * (1.0 - ring), x.y() * (1.0 - ring), x.z());
    ASSERT_LT((T.rotation() * normal).dot(Ray(u, v)), 1e-3);
  });
  EXPECT_GT(seen, 800);
}

TEST(DepthRenderer, TriangleSeenFromBehind_IsNotDrawn) {
  TriangleMesh mesh;
  mesh.vertices = {{-0.1, -0.1, 0.5}, {0.1, -0.1, 0.5}, {0.0, 0.1, 0.5}};
  for (const bool front : {true, false}) {
    mesh.triangles = {front ? TriangleMesh::Triangle{0, 2, 1} : TriangleMesh::Triangle{0, 1, 2}};
    DepthRenderer renderer(kCamera, kWidth_px, kHeight_px);
    renderer.DrawMesh(mesh, CameraFromMesh(), kLabel);
    EXPECT_EQ(renderer.labels()[Pixel(81, 57)], front ? kLabel : 0U);
  }
}

TEST(DepthRenderer, NearerThing_HidesTheFartherInAnyOrder) {
  const CameraFromMesh near_pose(Mat3d(Mat3d::Identity()), Vec3d(0.0, 0.0, 0.4));
  const CameraFromMesh far_pose(Mat3d(Mat3d::Identity()), Vec3d(0.0, 0.0, 0.8));
  const TriangleMesh box = MakeCrackerBox();
  DepthRenderer first(kCamera, kWidth_px, kHeight_px);
  first.DrawMesh(box, near_pose, 1U);
  first.DrawMesh(box, far_pose, 2);
  DepthRenderer second(kCamera, kWidth_px, kHeight_px);
  second.DrawMesh(box, far_pose, 2);
  second.DrawMesh(box, near_pose, 1U);
  EXPECT_EQ(first.labels()[Pixel(81, 58)], 1U);
  EXPECT_TRUE(std::equal(first.labels().begin(), first.labels().end(), second.labels().begin()));
}

TEST(DepthRenderer, MeshPartlyOutsideOfTheImageOrBehindTheCamera_DrawsWhatIsInView) {
  DepthRenderer renderer(kCamera, kWidth_px, kHeight_px);
  const TriangleMesh box = MakeCrackerBox();
  renderer.DrawMesh(box, {Mat3d(Mat3d::Identity()), Vec3d(-0.35, 0.0, 0.6)}, kLabel);
  renderer.DrawMesh(box, {Mat3d(Mat3d::Identity()), Vec3d(0.0, 0.0, -0.5)}, 9);
  renderer.DrawMesh(box, {Mat3d(Mat3d::Identity()), Vec3d(0.0, 0.0, 0.1)}, 9);
  EXPECT_EQ(renderer.labels()[Pixel(0, 58)], kLabel);
  EXPECT_EQ(std::count(renderer.labels().begin(), renderer.labels().end(), 9U), 0);
}

}  // namespace
}  // namespace disflow::host
