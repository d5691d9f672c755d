// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/surface_extractor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "mesh_collector.h"
#include "model_builder.h"

namespace disflow::testing {
namespace {

using Workspace = SurfaceWorkspace<profiles::Edge>;

SurfaceCounts Extract(const EdgeField& field, const SurfaceOptions& options, MeshCollector& mesh) {
  const auto workspace = std::make_unique<Workspace>();
  const Expected<SurfaceCounts> result = ExtractSurface(field, options, *workspace, mesh);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_EQ(result.value.triangles, static_cast<int>(mesh.triangles.size()));
  return result.value;
}

MeshCollector& ExtractInto(MeshCollector& mesh, const Shape& shape, const Observing& observing = {},
                           float resolution_m = 0.0025F) {
  SurfaceOptions options;
  options.resolution_m = resolution_m;
  Extract(*MakeModel(shape, observing), options, mesh);
  return mesh;
}

Observing Noisy() {
  Observing observing;
  observing.noise_m = 2e-4F;
  observing.normal_noise = 0.03F;
  return observing;
}

void ExpectClosed(const MeshCollector& mesh, const char* name) {
  const auto counts = mesh.CountEdges();
  EXPECT_GT(mesh.triangles.size(), 1000U) << name;
  EXPECT_EQ(counts.open, 0) << name;
  EXPECT_EQ(counts.ambiguous, 0) << name;
  EXPECT_EQ(mesh.EulerCharacteristic(), 2) << name;
}

TEST(SurfaceExtractor, FullySeenShape_IsOneClosedSurface) {
  MeshCollector sphere;
  ExpectClosed(ExtractInto(sphere, OddSphere()), "sphere");
  MeshCollector noisy_sphere;
  ExpectClosed(ExtractInto(noisy_sphere, OddSphere(), Noisy()), "noisy sphere");
  MeshCollector box;
  ExpectClosed(ExtractInto(box, OddBox(), Noisy()), "box");
  MeshCollector cylinder;
  ExpectClosed(ExtractInto(cylinder, OddCylinder(), Noisy()), "cylinder");
}

TEST(SurfaceExtractor, AnyResolution_StaysClosed) {
  for (const float resolution_m : {0.00125F, 0.0031F, 0.005F, 0.007F}) {
    MeshCollector mesh;
    ExtractInto(mesh, OddSphere(), Noisy(), resolution_m);
    EXPECT_EQ(mesh.CountEdges().open, 0) << resolution_m;
    EXPECT_EQ(mesh.EulerCharacteristic(), 2) << resolution_m;
  }
}

TEST(SurfaceExtractor, CleanObservations_VerticesLieOnTheSurface) {
  for (const Shape& shape : {OddSphere(), OddBox(), OddCylinder()}) {
    MeshCollector mesh;
    ExtractInto(mesh, shape);
    double sum_squared_m2 = 0.0;
    for (const SurfaceVertex& vertex : mesh.vertices) {
      const float distance_m = shape.distance_m(vertex.position_m);
      EXPECT_LT(std::abs(distance_m), 6e-4F);
      sum_squared_m2 += static_cast<double>(distance_m * distance_m);
    }
    EXPECT_LT(std::sqrt(sum_squared_m2 / static_cast<double>(mesh.vertices.size())), 1e-4);
  }
}

TEST(SurfaceExtractor, CleanSphere_NormalsPointOutwardWithinThreeDegrees) {
  MeshCollector mesh;
  ExtractInto(mesh, OddSphere());
  const Vec3 center_m = OddPlace().translation();
  int off = 0;
  for (const SurfaceVertex& vertex : mesh.vertices) {
    EXPECT_NEAR(vertex.normal.norm(), 1.0F, 1e-4F);
    const float cosine = vertex.normal.dot((vertex.position_m - center_m).normalized());
    EXPECT_GT(cosine, std::cos(0.12F));
    if (cosine < std::cos(3.0F * 0.01745F)) ++off;
  }
  EXPECT_LE(off, static_cast<int>(mesh.vertices.size()) / 100);
}

TEST(SurfaceExtractor, Triangles_HaveAreaAndFaceOutward) {
  MeshCollector mesh;
  ExtractInto(mesh, OddSphere(), Noisy());
  const Vec3 center_m = OddPlace().translation();
  for (const auto& triangle : mesh.triangles) {
    const Vec3 area = mesh.AreaVector(triangle);
    ASSERT_GT(area.norm(), 1e-11F);
    const Vec3& corner_m = mesh.vertices[static_cast<std::size_t>(triangle[0])].position_m;
    constexpr float kRounding_m3 = 1e-12F;  // a sliver's direction is no better than its corners
    EXPECT_GT(area.dot(corner_m - center_m), -kRounding_m3);
  }
}

TEST(SurfaceExtractor, ClosedMesh_EnclosesTheTrueVolume) {
  MeshCollector mesh;
  ExtractInto(mesh, OddBox());
  double six_volumes_m3 = 0.0;
  for (const auto& triangle : mesh.triangles) {
    six_volumes_m3 += static_cast<double>(mesh.AreaVector(triangle).dot(
        mesh.vertices[static_cast<std::size_t>(triangle[0])].position_m));
  }
  // Edges are chamfered by the grid: a little is missing, nothing is added.
  EXPECT_NEAR(six_volumes_m3 / 6.0 / (0.08 * 0.06 * 0.04), 1.0, 0.01);
}

TEST(SurfaceExtractor, HalfSeenSphere_IsOpenWhereNothingWasSeen) {
  const Vec3 center_m = OddPlace().translation();
  const auto seen = [=](const Vec3& x_m) { return x_m.z() > center_m.z(); };
  const SurfaceOptions options;
  const auto field = MakeModel(Seen(OddSphere(), seen), Noisy());
  MeshCollector mesh;
  Extract(*field, options, mesh);
  const auto counts = mesh.CountEdges();
  EXPECT_GT(counts.open, 50);
  EXPECT_EQ(counts.ambiguous, 0);
  EXPECT_EQ(mesh.EulerCharacteristic(), 1);  // A disc.

  std::vector<Vec3> samples_m;
  field->store().ForEach([&](Handle, const auto& cluster) {
    for (const ModelSample& sample : cluster.samples) samples_m.push_back(sample.position_m);
  });
  float top_m = -1.0F;
  for (const SurfaceVertex& vertex : mesh.vertices) {
    float nearest_m = 1.0F;
    for (const Vec3& sample_m : samples_m)
      nearest_m = std::fmin(nearest_m, (sample_m - vertex.position_m).norm());
    ASSERT_LE(nearest_m, options.support_radius_m * 1.0001F);
    top_m = std::max(top_m, vertex.position_m.z());
  }
  EXPECT_NEAR(top_m, center_m.z() + 0.04F, 1e-3F);
}

TEST(SurfaceExtractor, StandardDeviation_GrowsBeyondTheData) {
  const Transform<Object, Object> place = OddPlace();
  MeshCollector mesh;
  ExtractInto(mesh, OddPlane(), Noisy());
  double middle_m = 0.0;
  double rim_m = 0.0;
  int middle_count = 0;
  int rim_count = 0;
  for (const SurfaceVertex& vertex : mesh.vertices) {
    const Vec3 x_m = place.Inverse() * vertex.position_m;
    const float out_m = std::max(std::abs(x_m.x()), std::abs(x_m.y())) - 0.06F;
    ASSERT_GT(vertex.std_m, 0.0F);
    if (out_m < -0.01F) {
      middle_m += static_cast<double>(vertex.std_m);
      ++middle_count;
    } else if (out_m > 0.004F) {
      rim_m += static_cast<double>(vertex.std_m);
      ++rim_count;
    }
  }
  ASSERT_GT(middle_count, 0);
  ASSERT_GT(rim_count, 0);
  EXPECT_GT(rim_m / rim_count, 1.5 * middle_m / middle_count);
}

TEST(SurfaceExtractor, StandardDeviation_HasWhatEachPieceIsMisplacedBySinceTheFirstView) {
  constexpr float kPieces = 2.0F;
  constexpr float kPiece_m = 1e-3F;
  const auto owned = std::make_unique<EdgeField>();
  EdgeField& field = *owned;
  SurfaceOptions options;
  options.resolution_m = 0.005F;
  for (const float pieces : {0.0F, kPieces}) {
    field.Start({});
    field.SetGeneration(pieces);
    Counters counters;
    Fuse(OddSphere(), Noisy(), 1, field, counters);
    MeshCollector placed;
    Extract(field, options, placed);
    field.SetPieceVariance(kPiece_m * kPiece_m);
    MeshCollector misplaced;
    Extract(field, options, misplaced);
    ASSERT_EQ(placed.vertices.size(), misplaced.vertices.size());
    for (std::size_t i = 0; i < placed.vertices.size(); ++i) {
      EXPECT_NEAR(misplaced.vertices[i].std_m,
                  std::hypot(placed.vertices[i].std_m, std::sqrt(pieces) * kPiece_m), 1e-6F);
    }
  }
}

TEST(SurfaceExtractor, SameModel_GivesTheSameBits) {
  const auto field = MakeModel(OddCylinder(), Noisy());
  MeshCollector first;
  MeshCollector second;
  Extract(*field, {}, first);
  Extract(*field, {}, second);
  ASSERT_EQ(first.triangles, second.triangles);
  for (std::size_t i = 0; i < first.vertices.size(); ++i) {
    EXPECT_EQ(first.vertices[i].position_m, second.vertices[i].position_m);
    EXPECT_EQ(first.vertices[i].normal, second.vertices[i].normal);
    EXPECT_EQ(first.vertices[i].std_m, second.vertices[i].std_m);
  }
}

TEST(SurfaceExtractor, RarelySeenSamples_AreLeftOutOnRequest) {
  const auto field = MakeModel(OddSphere());
  Counters counters;
  std::mt19937 random(1);
  // One stray observation off the sphere.
  const Vec3 stray_m = OddPlace().translation() + Vec3(0.0F, 0.09F, 0.0F);
  EXPECT_EQ(field->Insert(Observe({stray_m, Vec3::UnitX()}, {}, random), 9, counters),
            EdgeField::Fusion::kAdded);
  (void)field->Retrain(1000, counters);
  SurfaceOptions options;
  MeshCollector with_stray;
  Extract(*field, options, with_stray);
  EXPECT_GT(with_stray.CountEdges().open, 0);
  options.min_observations = 2;
  MeshCollector without_stray;
  Extract(*field, options, without_stray);
  ExpectClosed(without_stray, "sphere without the stray sample");
}

TEST(SurfaceExtractor, StraySampleOnASurface_IsOutvotedByItsNeighbours) {
  const Shape sphere = OddSphere();
  const auto field = MakeModel(sphere);
  Counters counters;
  std::mt19937 random(1);
  const Vec3 direction = Vec3(0.3F, 0.8F, -0.5F).normalized();
  const SurfacePoint stray{OddPlace().translation() + 0.0405F * direction,
                           direction.unitOrthogonal()};
  for (std::uint32_t frame = 9; frame < 14; ++frame) {
    (void)field->Insert(Observe(stray, {}, random), frame, counters);
  }
  EXPECT_EQ(counters.observations_rejected, 0U);
  (void)field->Retrain(1000, counters);
  MeshCollector mesh;
  Extract(*field, {}, mesh);
  ExpectClosed(mesh, "sphere with a stray sample");
  for (const SurfaceVertex& vertex : mesh.vertices) {
    EXPECT_LT(std::abs(sphere.distance_m(vertex.position_m)), 6e-4F);
  }
}

/// As Edge, but too small for the whole object.
struct Tiny : profiles::Edge {
  static constexpr int kMaxNodes = 160;
  static constexpr int kMaxClusters = 40;
};

}  // namespace
}  // namespace disflow::testing

// A profile of our own is instantiated by the header that has the definitions.
#include "disflow/surface_extractor_impl.h"

namespace disflow::testing {
namespace {

TEST(SurfaceExtractor, PoolsOverflowed_WhatIsLeftIsStillTheSurface) {
  const Shape shape = OddSphere();
  const Vec3 center_m = OddPlace().translation();
  auto field = std::make_unique<DistanceField<Tiny>>();
  field->Start({});
  Counters counters;
  Observing observing;
  std::uint32_t frame = 1;
  // The object turns: one side after the other is seen.
  for (const float side : {-1.0F, 1.0F}) {
    const auto seen = [=](const Vec3& x_m) { return side * (x_m.z() - center_m.z()) > 0.0F; };
    Fuse(Seen(shape, seen), observing, frame, *field, counters);
    frame += 10;
  }
  EXPECT_GT(counters.clusters_evicted, 0U);
  MeshCollector mesh;
  const auto workspace = std::make_unique<SurfaceWorkspace<Tiny>>();
  ASSERT_EQ(ExtractSurface(*field, SurfaceOptions{}, *workspace, mesh).status, Status::kOk);
  EXPECT_GT(mesh.triangles.size(), 1000U);
  EXPECT_EQ(mesh.CountEdges().ambiguous, 0);
  for (const SurfaceVertex& vertex : mesh.vertices) {
    // Beyond the data the surface is continued by up to the support radius.
    EXPECT_LT(std::abs(shape.distance_m(vertex.position_m)), 2e-3F);
  }
}

TEST(SurfaceExtractor, EmptyModel_SaysNotInitialised) {
  auto field = std::make_unique<EdgeField>();
  field->Start({});
  MeshCollector mesh;
  const auto workspace = std::make_unique<Workspace>();
  EXPECT_EQ(ExtractSurface(*field, SurfaceOptions{}, *workspace, mesh).status,
            Status::kNotInitialised);
}

TEST(SurfaceExtractor, UnusableOptions_AreRefused) {
  const auto field = MakeModel(OddPlane());
  const auto workspace = std::make_unique<Workspace>();
  const float cell_m = field->config().cell_size_m;
  MeshCollector mesh;
  for (const float bad : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity()}) {
    SurfaceOptions options;
    options.resolution_m = bad;
    EXPECT_EQ(ExtractSurface(*field, options, *workspace, mesh).status, Status::kInvalidConfig)
        << bad;
    options = {};
    options.support_radius_m = bad;
    EXPECT_EQ(ExtractSurface(*field, options, *workspace, mesh).status, Status::kInvalidConfig)
        << bad;
  }
  SurfaceOptions options;
  options.resolution_m = cell_m / 17.0F;
  EXPECT_EQ(ExtractSurface(*field, options, *workspace, mesh).status, Status::kInvalidConfig);
  EXPECT_TRUE(mesh.triangles.empty());
  options.resolution_m = cell_m / 16.0F;
  EXPECT_EQ(ExtractSurface(*field, options, *workspace, mesh).status, Status::kOk);
}

class SampleCollector final : public SampleSink {
 public:
  std::vector<SurfaceVertex> samples;
  int fewest_observations = 1000;

 private:
  void DoOnSample(const SurfaceVertex& sample, int observations) noexcept override {
    samples.push_back(sample);
    fewest_observations = std::min(fewest_observations, observations);
  }
};

TEST(SampleStream, Model_GivesEverySampleOnce) {
  const Shape sphere = OddSphere();
  const auto field = MakeModel(sphere, Noisy());
  SampleCollector collector;
  const int count = StreamSamples(*field, collector);
  ASSERT_EQ(count, static_cast<int>(collector.samples.size()));
  EXPECT_GT(count, 500);
  EXPECT_GE(collector.fewest_observations, 1);
  for (const SurfaceVertex& sample : collector.samples) {
    EXPECT_LT(std::abs(sphere.distance_m(sample.position_m)), 1.2e-3F);
    EXPECT_GT(sample.std_m, 0.0F);
    EXPECT_LE(sample.std_m, 2.01e-4F);
    EXPECT_NEAR(sample.normal.norm(), 1.0F, 1e-4F);
  }
}

}  // namespace
}  // namespace disflow::testing
