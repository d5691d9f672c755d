// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sphere_mesh.h"

namespace disflow::apps {
namespace {

constexpr double kRadius_m = 0.05;

MeshComparison CompareSpheres(const Surface& mesh, const std::vector<bool>& seen = {}) {
  const Surface model = MakeSphere(kRadius_m, Vec3d::Zero());
  return CompareMeshes(mesh, model, SampleSurface(model, kMeshSamples), seen);
}

TEST(MeshMetricsTest, TheSameSurface_HasNoDistance) {
  const MeshMetrics m = CompareSpheres(MakeSphere(kRadius_m, Vec3d::Zero())).whole;
  EXPECT_NEAR(m.chamfer_m, 0.0, 1e-9);
  EXPECT_NEAR(m.hausdorff_m, 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(m.f_score[0], 1.0);
  EXPECT_NEAR(m.mesh_to_model_normal_rad, 0.0, 1e-3);
}

TEST(MeshMetricsTest, LargerSphere_IsItsOffsetAwayEverywhere) {
  const MeshMetrics m = CompareSpheres(MakeSphere(kRadius_m + 0.0015, Vec3d::Zero())).whole;
  // The chords of the mesh lie up to r (1 - cos(pi / 256)) = 4 um inside of the sphere.
  EXPECT_NEAR(m.accuracy_m, 0.0015, 1e-5);
  EXPECT_NEAR(m.completeness_m, 0.0015, 1e-5);
  EXPECT_NEAR(m.chamfer_m, 0.0015, 1e-5);
  EXPECT_NEAR(m.hausdorff_m, 0.0015, 1e-4);
  EXPECT_DOUBLE_EQ(m.f_score[0], 0.0);
  EXPECT_DOUBLE_EQ(m.f_score[1], 1.0);
  EXPECT_DOUBLE_EQ(m.f_score[2], 1.0);
}

TEST(MeshMetricsTest, ShiftedSphere_HasTheMeanOfTheProjectedShift) {
  // For a small shift s the distance is s |cos|, whose mean over the sphere is s / 2.
  const double shift = 0.001;
  const MeshMetrics m = CompareSpheres(MakeSphere(kRadius_m, Vec3d(shift, 0, 0))).whole;
  EXPECT_NEAR(m.chamfer_m, 0.5 * shift, 2e-5);
  EXPECT_NEAR(m.hausdorff_m, shift, 2e-5);
}

TEST(MeshMetricsTest, InsideOutMesh_HasOppositeNormals) {
  Surface flipped = MakeSphere(kRadius_m, Vec3d::Zero(), 128, false);
  for (auto& triangle : flipped.triangles) std::swap(triangle[1], triangle[2]);
  const MeshMetrics m = CompareSpheres(flipped).whole;
  EXPECT_NEAR(m.mesh_to_model_normal_rad, std::numbers::pi, 0.03);
  EXPECT_NEAR(m.model_to_mesh_normal_rad, std::numbers::pi, 0.03);
}

TEST(MeshMetricsTest, HalfAMesh_IsAccurateButIncomplete) {
  Surface half = MakeSphere(kRadius_m, Vec3d::Zero());
  half.triangles.resize(half.triangles.size() / 2);  // the upper hemisphere
  const MeshMetrics m = CompareSpheres(half).whole;
  EXPECT_NEAR(m.accuracy_m, 0.0, 1e-6);
  EXPECT_GT(m.completeness_m, 0.005);
  // The far pole's nearest point lies on the equator.
  EXPECT_NEAR(m.hausdorff_m, std::sqrt(2.0) * kRadius_m, 1e-3);
  EXPECT_NEAR(m.f_score[0], 2.0 / 3.0, 0.02);  // precision 1, recall 1/2
}

TEST(MeshMetricsTest, SeenPart_JudgesOnlyWhatWasSeen) {
  Surface half = MakeSphere(kRadius_m, Vec3d::Zero());
  half.triangles.resize(half.triangles.size() / 2);
  const Surface model = MakeSphere(kRadius_m, Vec3d::Zero());
  std::vector<bool> seen;
  for (const SurfacePoint& point : SampleSurface(model, kMeshSamples)) {
    seen.push_back(point.position.z() > 0.0);
  }
  const MeshComparison comparison = CompareSpheres(half, seen);
  EXPECT_NEAR(comparison.seen_share, 0.5, 0.01);
  EXPECT_NEAR(comparison.seen.completeness_m, 0.0, 1e-6);
  EXPECT_DOUBLE_EQ(comparison.seen.f_score[0], 1.0);
  EXPECT_LT(comparison.whole.f_score[0], 0.7);
}

TEST(MeshMetricsTest, NothingKnownOfWhatWasSeen_IsNan) {
  const MeshComparison comparison = CompareSpheres(MakeSphere(kRadius_m, Vec3d::Zero()));
  EXPECT_TRUE(std::isnan(comparison.seen_share));
  EXPECT_TRUE(std::isnan(comparison.seen.chamfer_m));
  EXPECT_TRUE(std::isnan(comparison.seen.f_score[0]));
}

TEST(MeshMetricsTest, TwoTriangles_HaveTheFiguresOfTheDrawing) {
  // The model: unit right triangle in z = 0. The mesh: the same one lifted by 1.5 mm, and a copy
  // 100 mm below that stands alone. Of the mesh half lies within 2 mm, of the model all does.
  const auto triangle = [](double z_m) {
    return std::array<Vec3d, 3>{Vec3d(0, 0, z_m), Vec3d(0.1, 0, z_m), Vec3d(0, 0.1, z_m)};
  };
  Surface model;
  for (const Vec3d& corner : triangle(0.0)) model.vertices.push_back(corner);
  model.triangles = {{0, 1, 2}};
  Surface mesh;
  for (const double z_m : {0.0015, -0.1}) {
    for (const Vec3d& corner : triangle(z_m)) mesh.vertices.push_back(corner);
  }
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}};  // the stray one faces down
  const MeshMetrics m = CompareMeshes(mesh, model, SampleSurface(model, kMeshSamples), {}).whole;
  EXPECT_NEAR(m.accuracy_m, 0.5 * (0.0015 + 0.1), 1e-5);
  EXPECT_NEAR(m.completeness_m, 0.0015, 1e-9);
  EXPECT_NEAR(m.chamfer_m, 0.5 * (m.accuracy_m + m.completeness_m), 1e-12);
  EXPECT_NEAR(m.hausdorff_m, 0.1, 1e-9);
  EXPECT_DOUBLE_EQ(m.f_score[0], 0.0);
  EXPECT_NEAR(m.f_score[1], 2.0 * 0.5 / 1.5, 1e-4);  // precision 1/2, recall 1
  EXPECT_NEAR(m.mesh_to_model_normal_rad, 0.5 * std::numbers::pi, 1e-3);
  EXPECT_NEAR(m.model_to_mesh_normal_rad, 0.0, 1e-9);
}

TEST(MeshMetricsTest, PointClouds_AreComparedByTheirPoints) {
  Surface mesh;
  mesh.vertices = {Vec3d(0, 0, 0), Vec3d(1, 0, 0)};
  Surface model;
  model.vertices = {Vec3d(0, 0, 0.004)};
  const MeshMetrics m = CompareMeshes(mesh, model, SampleSurface(model, 1), {}).whole;
  EXPECT_NEAR(m.completeness_m, 0.004, 1e-12);
  EXPECT_NEAR(m.accuracy_m, 0.5 * (0.004 + std::hypot(1.0, 0.004)), 1e-12);
  EXPECT_TRUE(std::isnan(m.mesh_to_model_normal_rad));
}

}  // namespace
}  // namespace disflow::apps
