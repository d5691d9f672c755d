// SPDX-License-Identifier: BSD-3-Clause
#include "surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nearest_surface.h"
#include "sphere_mesh.h"

namespace disflow::apps {
namespace {

/// A 1 m x 2 m rectangle in the plane z = 0, of one large and two small triangles.
Surface MakeRectangle() {
  Surface s;
  s.vertices = {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(1, 2, 0), Vec3d(0, 2, 0), Vec3d(0, 1, 0)};
  s.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}};
  return s;
}

TEST(SampleSurfaceTest, Samples_AreSpreadByArea) {
  const auto points = SampleSurface(MakeRectangle(), 10000);
  ASSERT_EQ(points.size(), 10000U);
  // Each cell of a 4 x 8 grid holds 1/32 of the area.
  std::array<int, 32> counts{};
  for (const SurfacePoint& point : points) {
    EXPECT_EQ(point.position.z(), 0.0);
    EXPECT_EQ(point.normal, Vec3d(0, 0, 1));
    const int column = static_cast<int>(4.0 * point.position.x());
    const int row = static_cast<int>(4.0 * point.position.y());
    ASSERT_GE(column, 0);
    ASSERT_LT(column, 4);
    ASSERT_GE(row, 0);
    ASSERT_LT(row, 8);
    ++counts[static_cast<std::size_t>(4 * row + column)];
  }
  for (const int count : counts) EXPECT_NEAR(count, 10000.0 / 32.0, 30.0);
}

TEST(SampleSurfaceTest, PointCloud_IsKeptAsItIs) {
  Surface cloud;
  cloud.vertices = {Vec3d(1, 2, 3), Vec3d(4, 5, 6)};
  const auto points = SampleSurface(cloud, 1000);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1].position, Vec3d(4, 5, 6));
  EXPECT_TRUE(points[1].normal.isZero());
}

TEST(SampleSurfaceTest, TriangleWithoutArea_TakesNoSampleAndGivesNoNan) {
  Surface s = MakeRectangle();
  s.triangles.insert(s.triangles.begin(), {0, 0, 1});
  s.triangles.push_back({2, 2, 2});
  for (const SurfacePoint& point : SampleSurface(s, 500)) {
    EXPECT_TRUE(point.position.allFinite());
    EXPECT_GE(point.element, 1U);
    EXPECT_LE(point.element, 3U);
  }
}

TEST(MoveTest, RigidMotion_TurnsNormalsWithThePoints) {
  Surface s = MakeSphere(0.1, Vec3d::Zero(), 8);
  const Transform<Object, Object, double> T(ExpSo3(Vec3d(0, 0, 1.0)), Vec3d(1, 2, 3));
  const Surface moved = Move(T, s);
  for (std::size_t i = 0; i < s.vertices.size(); ++i) {
    EXPECT_TRUE(moved.normals[i].isApprox((moved.vertices[i] - Vec3d(1, 2, 3)) / 0.1, 1e-9));
  }
}

TEST(NearestBarycentricTest, EveryRegionOfATriangle_GivesItsNearestPoint) {
  const Vec3d a(0, 0, 0);
  const Vec3d b(2, 0, 0);
  const Vec3d c(0, 2, 0);
  const auto nearest = [&](const Vec3d& query) {
    const Vec3d w = NearestBarycentric(a, b, c, query);
    return Vec3d(w[0] * a + w[1] * b + w[2] * c);
  };
  EXPECT_TRUE(nearest({-1, -1, 3}).isApprox(a));  // corners
  EXPECT_TRUE(nearest({5, -1, 0}).isApprox(b));
  EXPECT_TRUE(nearest({-1, 5, 1}).isApprox(c));
  EXPECT_TRUE(nearest({1, -4, 2}).isApprox(Vec3d(1, 0, 0)));  // edges
  EXPECT_TRUE(nearest({-4, 1, 2}).isApprox(Vec3d(0, 1, 0)));
  EXPECT_TRUE(nearest({3, 3, 2}).isApprox(Vec3d(1, 1, 0)));
  EXPECT_TRUE(nearest({0.5, 0.25, 7}).isApprox(Vec3d(0.5, 0.25, 0)));  // inside
}

TEST(NearestSurfaceTest, DistanceToAMesh_IsNotLimitedByTheSpacingOfSamples) {
  const Surface plane = MakeRectangle();
  const NearestSurface nearest(plane, SampleSurface(plane, 200));
  for (int i = 0; i < 50; ++i) {
    const Vec3d query(0.02 * i, 2.0 - 0.03 * i, 0.001 * i);
    const NearestSurface::Hit hit = nearest.Find(query);
    EXPECT_NEAR(hit.distance, 0.001 * i, 1e-12);
    EXPECT_TRUE(hit.point.position.isApprox(Vec3d(query.x(), query.y(), 0.0), 1e-9));
  }
}

}  // namespace
}  // namespace disflow::apps
