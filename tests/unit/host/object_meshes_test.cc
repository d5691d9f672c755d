// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/object_meshes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "closed_mesh.h"

namespace disflow::host {
namespace {

double Volume(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (const auto& t : mesh.triangles) {
    volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
  }
  return volume;
}

Vec3d High(const TriangleMesh& mesh) {
  Vec3d high = mesh.vertices.front();
  for (const Vec3d& vertex : mesh.vertices) high = high.cwiseMax(vertex);
  return high;
}

Vec3d Low(const TriangleMesh& mesh) {
  Vec3d low = mesh.vertices.front();
  for (const Vec3d& vertex : mesh.vertices) low = low.cwiseMin(vertex);
  return low;
}

struct KnownObject {
  const char* name;
  TriangleMesh (*make)();
  Vec3d size_m;
};

void PrintTo(const KnownObject& object, std::ostream* stream) { *stream << object.name; }

class ObjectMesh : public testing::TestWithParam<KnownObject> {};

TEST_P(ObjectMesh, IsClosedAndFacesOutwards) {
  const TriangleMesh mesh = GetParam().make();
  EXPECT_TRUE(IsClosed(mesh));
  EXPECT_GT(Volume(mesh), 0.0);
}

TEST_P(ObjectMesh, HasItsSizeAboutTheOrigin) {
  const TriangleMesh mesh = GetParam().make();
  constexpr double kTolerance_m = 0.0015;
  const Vec3d size = High(mesh) - Low(mesh);
  EXPECT_TRUE((size - GetParam().size_m).cwiseAbs().maxCoeff() < kTolerance_m) << size.transpose();
  EXPECT_LT((High(mesh) + Low(mesh)).norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    All, ObjectMesh,
    testing::Values(KnownObject{"Box", MakeCrackerBox, {0.164, 0.072, 0.213}},
                    KnownObject{"Bottle", MakeMustardBottle, {0.095, 0.058, 0.191}},
                    KnownObject{"Can", MakeCan, {0.102, 0.102, 0.140}},
                    KnownObject{"Doughnut", MakeDoughnut, {0.120, 0.120, 0.040}},
                    KnownObject{
                        "RoundedBox", [] { return MakeRoundedBox(); }, {0.160, 0.070, 0.200}},
                    KnownObject{"FlatBox", [] { return MakeFlatBox(); }, {0.090, 0.075, 0.030}},
                    KnownObject{"Mug", MakeMug, {0.116, 0.084, 0.095}},
                    KnownObject{"Bowl", MakeBowl, {0.1483, 0.1483, 0.0601}},
                    KnownObject{"Tube", MakeTube, {0.054, 0.054, 0.160}},
                    KnownObject{"Superellipsoid", MakeSuperellipsoid, {0.100, 0.070, 0.140}},
                    KnownObject{"Screwdriver", MakeScrewdriver, {0.032, 0.032, 0.215}},
                    KnownObject{"Bracket", MakeBracket, {0.090, 0.065, 0.040}},
                    KnownObject{"SprayBottle", MakeSprayBottle, {0.112, 0.058, 0.203}}),
    [](const auto& test) { return test.param.name; });

TEST(Doughnut, Facets_StayWithin50MicrometresOfTheTorus) {
  const TriangleMesh mesh = MakeDoughnut();
  for (const auto& t : mesh.triangles) {
    const Vec3d centre = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
    const double ring = std::hypot(centre.x(), centre.y()) - 0.040;
    ASSERT_NEAR(std::hypot(ring, centre.z()), 0.020, 5e-5);
  }
}

/// Distance from the surface of a box whose edges are rounded, by its definition.
double RoundedBoxDistance(const Vec3d& x, const Vec3d& half_m, double radius_m) {
  const Vec3d core = half_m - Vec3d::Constant(radius_m);
  return (x - x.cwiseMin(core).cwiseMax(-core)).norm() - radius_m;
}

TEST(RoundedBoxes, Facets_StayWithin50MicrometresOfTheRoundedShape) {
  const auto check = [](const TriangleMesh& mesh, const Vec3d& size_m, double radius_m) {
    for (const auto& t : mesh.triangles) {
      const Vec3d centre = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
      ASSERT_NEAR(RoundedBoxDistance(centre, 0.5 * size_m, radius_m), 0.0, 5e-5);
    }
    for (const Vec3d& x : mesh.vertices)
      if (x.norm() > 0.0 && std::abs(x.x()) + std::abs(x.y()) > 0.0) {
        ASSERT_NEAR(RoundedBoxDistance(x, 0.5 * size_m, radius_m), 0.0, 1e-12);
      }
  };
  check(MakeRoundedBox(), Vec3d(0.160, 0.070, 0.200), 0.004);
  check(MakeFlatBox(), Vec3d(0.090, 0.075, 0.030), 0.002);
}

TEST(Mug, IsHollowAndHasAHandleOnOneSide) {
  const TriangleMesh mesh = MakeMug();
  double farthest_m = 0.0;
  bool has_floor = false;
  for (const Vec3d& x : mesh.vertices) {
    farthest_m = std::max(farthest_m, x.x());
    has_floor =
        has_floor || (std::hypot(x.x(), x.y()) < 0.02 && x.z() > -0.0475 + 0.005 && x.z() < 0.0);
  }
  EXPECT_GT(farthest_m, -Low(mesh).x() - 1e-9);
  EXPECT_TRUE(has_floor);
  // Walls of 5 mm, a floor of 6 mm and a handle: far less than a solid cylinder's 526 cm3.
  EXPECT_LT(Volume(mesh), 2e-4);
}

TEST(Bottle, HalfATurn_DoesNotMapItOntoItself) {
  const TriangleMesh mesh = MakeMustardBottle();
  // Its back reaches farther than its front, measured from the nozzle's axis.
  Vec3d tip = mesh.vertices.front();
  for (const Vec3d& v : mesh.vertices) {
    if (v.z() > tip.z()) tip = v;
  }
  EXPECT_GT(std::abs(tip.y()), 0.002);
}

TEST(SampleSurface, Points_AreSpreadByArea) {
  const TriangleMesh box = MakeCrackerBox();
  constexpr int kCount = 4000;
  const std::vector<Vec3d> points = SampleSurface(box, kCount);
  ASSERT_EQ(points.size(), static_cast<std::size_t>(kCount));
  const Vec3d half(0.082, 0.036, 0.1065);
  const Vec3d face_area(half.y() * half.z(), half.x() * half.z(), half.x() * half.y());
  Vec3d on_face = Vec3d::Zero();
  for (const Vec3d& point : points) {
    int axis = 0;
    const double deviation = (point.cwiseAbs() - half).cwiseAbs().minCoeff(&axis);
    ASSERT_LT(deviation, 1e-12) << "not on the surface";
    on_face[axis] += 1.0 / kCount;
  }
  EXPECT_LT((on_face - face_area / face_area.sum()).cwiseAbs().maxCoeff(), 0.005);
  EXPECT_EQ(SampleSurface(box, kCount), points) << "not the same on every call";
}

}  // namespace
}  // namespace disflow::host
