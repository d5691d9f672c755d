// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/mesh_shaping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "closed_mesh.h"
#include "disflow/host/object_meshes.h"
#include "disflow/host/simulated_object.h"

namespace disflow::host {
namespace {

double Area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3d& a = mesh.vertices[t[0]];
    area += 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
  }
  return area;
}

double LongestEdge(const TriangleMesh& mesh) {
  double longest = 0.0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i)
      longest = std::max(longest, (mesh.vertices[t[i]] - mesh.vertices[t[(i + 1) % 3]]).norm());
  }
  return longest;
}

/// Distance from a box, negative inside.
double DistanceFromBox(const Vec3d& x, const Vec3d& half_m) {
  const Vec3d beyond = x.cwiseAbs() - half_m;
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

TEST(Refine, KeepsTheSurface_AndLeavesNoLongEdge) {
  TriangleMesh mesh = MakeCrackerBox();
  const double area = Area(mesh);
  Refine(mesh, 0.01);
  EXPECT_LE(LongestEdge(mesh), 0.01);
  EXPECT_TRUE(IsClosed(mesh));
  EXPECT_NEAR(Area(mesh), area, 1e-12);
  const Vec3d half_m = 0.5 * Vec3d(0.164, 0.072, 0.213);
  for (const Vec3d& x : mesh.vertices) ASSERT_NEAR(DistanceFromBox(x, half_m), 0.0, 1e-12);
}

TEST(BulgeFaces, AreHighestInTheMiddle_AndLeaveTheEdgesWhereTheyWere) {
  const double bulge_m = 0.001;
  const Vec3d half_m = 0.5 * Vec3d(0.160, 0.070, 0.200);
  TriangleMesh mesh = MakeRoundedBox(0.004);
  BulgeFaces(mesh, 0.004, bulge_m);
  EXPECT_TRUE(IsClosed(mesh));
  double highest_m = 0.0;
  for (const Vec3d& x : mesh.vertices) {
    const double height_m = DistanceFromBox(x, half_m);
    highest_m = std::max(highest_m, height_m);
    const Vec3d from_rim = half_m - x.cwiseAbs();
    // Near two faces at once is near an edge.
    const bool at_edge = (from_rim.array() < 0.004).count() >= 2;
    if (at_edge) {
      ASSERT_LT(height_m, 1e-6);
    }
    ASSERT_LT(height_m, bulge_m + 1e-9);
  }
  EXPECT_GT(highest_m, 0.95 * bulge_m);
}

TEST(Warp, MovesSurfaceByItsStandardDeviation_SmoothlyAndAlikeEveryTime) {
  const double std_m = 0.0004;
  const Vec3d half_m = 0.5 * Vec3d(0.164, 0.072, 0.213);
  TriangleMesh mesh = MakeCrackerBox();
  Warp(mesh, std_m);
  EXPECT_TRUE(IsClosed(mesh));
  double squares = 0.0;
  for (const Vec3d& x : mesh.vertices) squares += std::pow(DistanceFromBox(x, half_m), 2);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(mesh.vertices.size())), std_m, 0.15 * std_m);
  TriangleMesh again = MakeCrackerBox();
  Warp(again, std_m);
  EXPECT_EQ(mesh.vertices, again.vertices);
}

TEST(Warp, LeavesAThinWallItsThickness) {
  const double wall_m = 0.003;
  TriangleMesh mesh = MakeTube();
  Refine(mesh, 0.004);
  const TriangleMesh drawn = mesh;
  Warp(mesh, 0.0005);
  // Pairs of points that face each other through the wall.
  int pairs = 0;
  for (std::size_t i = 0; i < drawn.vertices.size(); ++i) {
    const Vec3d& outer = drawn.vertices[i];
    if (std::hypot(outer.x(), outer.y()) < 0.0269 || std::abs(outer.z()) > 0.02) continue;
    const Vec3d inwards = -wall_m * Vec3d(outer.x(), outer.y(), 0.0).normalized();
    for (std::size_t k = 0; k < drawn.vertices.size(); ++k) {
      if ((outer + inwards - drawn.vertices[k]).norm() > 2e-4) continue;
      ASSERT_NEAR((mesh.vertices[i] - mesh.vertices[k]).norm(), wall_m, 0.0012);
      ++pairs;
    }
  }
  EXPECT_GT(pairs, 10);
}

hal::Fault Load(const char* object, const char* key, const char* value, TriangleMesh& mesh) {
  SimulationOptions options;
  hal::Fault fault = SetSimulationObject(object, options);
  if (fault.ok()) fault = SetSimulationOption(key, value, options);
  return fault.ok() ? LoadSimulatedObject(options, mesh) : fault;
}

TEST(SurfaceFinish, ThatNoObjectHas_IsRefusedByName) {
  TriangleMesh mesh;
  EXPECT_TRUE(Load("rounded-box", "edge_mm", "8", mesh).ok());
  EXPECT_TRUE(Load("box+bottle", "bulge_mm", "1", mesh).ok());
  EXPECT_TRUE(Load("bottle", "uneven_mm", "0.5", mesh).ok());
  EXPECT_NE(std::string_view(Load("bottle", "edge_mm", "5", mesh).message).find("edge_mm=5"),
            std::string_view::npos);
  EXPECT_NE(std::string_view(Load("mug", "bulge_mm", "1", mesh).message).find("bulge_mm=1"),
            std::string_view::npos);
  EXPECT_FALSE(Load("rounded-box", "edge_mm", "40", mesh).ok());
}

TEST(SurfaceFinish, RoundsTheEdgesThatItIsAskedFor) {
  TriangleMesh mesh;
  ASSERT_TRUE(Load("rounded-box", "edge_mm", "8", mesh).ok());
  double nearest_m = 1.0;  // to the corner that a sharp box would have
  for (const Vec3d& x : mesh.vertices)
    nearest_m = std::min(nearest_m, (x - 0.5 * Vec3d(0.160, 0.070, 0.200)).norm());
  EXPECT_NEAR(nearest_m, 0.008 * (std::sqrt(3.0) - 1.0), 3e-4);
}

}  // namespace
}  // namespace disflow::host
