// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "disflow/field/distance_query.h"
#include "disflow/surface_extractor.h"
#include "disflow/tracker.h"
#include "tracked_box.h"

namespace disflow::testing {
namespace {

constexpr float kSupport_m = 0.008F;

/// One frame of the box in both trackers.
class CModel : public ::testing::Test {
 protected:
  void SetUp() override {
    const DepthScene scene = BoxAt(0.0F);
    const disflow_frame frame = InC(scene.frame());
    disflow_estimate estimate;
    Estimate expected;
    ASSERT_EQ(tracker_->Process(scene.frame(), expected), Status::kOk);
    ASSERT_EQ(disflow_process(in_c_.get(), &frame, &estimate), DISFLOW_OK);
  }
  std::unique_ptr<Tracker<profiles::Micro>> tracker_ = std::make_unique<Tracker<profiles::Micro>>();
  TrackerInC in_c_;
};

std::vector<float> Flat(const disflow_vertex& vertex) {
  std::vector<float> all(vertex.position_m, vertex.position_m + 3);
  all.insert(all.end(), vertex.normal, vertex.normal + 3);
  all.push_back(vertex.std_m);
  return all;
}
std::vector<float> Flat(const SurfaceVertex& vertex) {
  std::vector<float> all(vertex.position_m.data(), vertex.position_m.data() + 3);
  all.insert(all.end(), vertex.normal.data(), vertex.normal.data() + 3);
  all.push_back(vertex.std_m);
  return all;
}
using Vertices = std::vector<std::vector<float>>;

class Keep final : public TriangleSink, public SampleSink {
 public:
  Vertices vertices;
  std::vector<int> observations;

 private:
  void DoOnTriangle(const SurfaceVertex& a, const SurfaceVertex& b,
                    const SurfaceVertex& c) noexcept override {
    for (const SurfaceVertex* vertex : {&a, &b, &c}) vertices.push_back(Flat(*vertex));
  }
  void DoOnSample(const SurfaceVertex& sample, int seen) noexcept override {
    vertices.push_back(Flat(sample));
    observations.push_back(seen);
  }
};

TEST_F(CModel, Surface_IsThatOfTheCppModel) {
  const auto workspace = std::make_unique<SurfaceWorkspace<profiles::Micro>>();
  Keep expected;
  ASSERT_TRUE(ExtractSurface(tracker_->field(), {}, *workspace, expected).ok());
  Vertices vertices;
  const auto keep = [](void* context, const disflow_vertex* three) {
    for (int i = 0; i < 3; ++i) static_cast<Vertices*>(context)->push_back(Flat(three[i]));
  };
  ASSERT_EQ(disflow_surface(in_c_.get(), 0.0F, 0.0F, in_c_.workspace(), in_c_.workspace_bytes(),
                            keep, &vertices),
            DISFLOW_OK);
  EXPECT_GT(vertices.size(), 100U);
  EXPECT_EQ(vertices, expected.vertices);
}

TEST_F(CModel, Samples_AreThoseOfTheCppModel) {
  Keep expected;
  const int count = StreamSamples(tracker_->field(), expected);
  struct Kept {
    Vertices vertices;
    std::vector<int> observations;
  } kept;
  const auto keep = [](void* context, const disflow_vertex* sample, std::int32_t observations) {
    static_cast<Kept*>(context)->vertices.push_back(Flat(*sample));
    static_cast<Kept*>(context)->observations.push_back(observations);
  };
  EXPECT_EQ(disflow_samples(in_c_.get(), keep, &kept), count);
  EXPECT_GT(count, 50);
  EXPECT_EQ(kept.vertices, expected.vertices);
  EXPECT_EQ(kept.observations, expected.observations);
}

TEST_F(CModel, Distances_AreThoseOfTheCppModel) {
  const auto workspace = std::make_unique<DistanceQuerier<profiles::Micro>::Workspace>();
  DistanceQuerier<profiles::Micro> querier(tracker_->field(), *workspace, kSupport_m);
  const std::vector<float> points{0.0F,   0.0F,  0.0F, 0.02F,
                                  -0.03F, 0.01F, 0.1F, 0.05F,
                                  0.2F,   0.0F,  0.0F, std::numeric_limits<float>::quiet_NaN()};
  std::vector<disflow_distance> distances(4);
  ASSERT_EQ(disflow_query(in_c_.get(), points.data(), 4, 0.0F, in_c_.workspace(),
                          in_c_.workspace_bytes(), distances.data()),
            DISFLOW_OK);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto expected = querier.Query(Vec3(points[3 * i], points[3 * i + 1], points[3 * i + 2]));
    EXPECT_EQ(distances[i].status, static_cast<int>(expected.status)) << i;
    EXPECT_EQ(distances[i].distance_m, expected.value.distance_m) << i;
    EXPECT_EQ(distances[i].variance_m2, expected.value.variance_m2) << i;
    EXPECT_EQ(distances[i].in_bounds != 0, expected.value.in_bounds) << i;
    for (int k = 0; k < 3; ++k) EXPECT_EQ(distances[i].gradient[k], expected.value.gradient[k]);
  }
  EXPECT_EQ(distances[3].status, DISFLOW_OUT_OF_BOUNDS);
}

TEST_F(CModel, FusedFrame_YieldsTheModelOfTheCppTracker) {
  const auto fused = std::make_unique<Tracker<profiles::Micro>>();
  TrackerInC fused_in_c;
  for (int i = 0; i < 3; ++i) {
    const DepthScene scene = BoxAt(0.0F);
    DepthFrame frame = scene.frame();
    frame.stamp_ns = StampOf(i);
    const disflow_frame c_frame = InC(frame);
    const disflow_pose T_oc{{0.0F, 0.0F, -0.4F}, {0.0F, 0.0F, 0.0F, 1.0F}};
    Estimate expected;
    disflow_estimate estimate;
    (void)fused->Fuse(frame, {Mat3(Mat3::Identity()), Vec3(0.0F, 0.0F, -0.4F)}, expected);
    EXPECT_EQ(disflow_fuse(fused_in_c.get(), &c_frame, &T_oc, &estimate),
              static_cast<int>(expected.status));
    EXPECT_NEAR(estimate.T_co.position_m[2], 0.4F, 1e-6F);
  }
  Keep expected;
  Vertices vertices;
  (void)StreamSamples(fused->field(), expected);
  const auto keep = [](void* context, const disflow_vertex* sample, std::int32_t) {
    static_cast<Vertices*>(context)->push_back(Flat(*sample));
  };
  EXPECT_GT(disflow_samples(fused_in_c.get(), keep, &vertices), 50);
  EXPECT_EQ(vertices, expected.vertices);
}

TEST_F(CModel, WorkspaceThatWillNotDo_IsRefused) {
  const auto ignore = [](void*, const disflow_vertex*) { FAIL() << "called"; };
  auto* const odd = static_cast<unsigned char*>(in_c_.workspace()) + 4;
  EXPECT_EQ(disflow_surface(in_c_.get(), 0.0F, 0.0F, in_c_.workspace(), 100, ignore, nullptr),
            DISFLOW_CAPACITY_EXCEEDED);
  EXPECT_EQ(disflow_surface(in_c_.get(), 0.0F, 0.0F, odd, in_c_.workspace_bytes(), ignore, nullptr),
            DISFLOW_CAPACITY_EXCEEDED);
  EXPECT_EQ(disflow_surface(in_c_.get(), 0.0F, 0.0F, nullptr, 0, ignore, nullptr),
            DISFLOW_NOT_INITIALISED);
  EXPECT_EQ(disflow_surface(in_c_.get(), -1.0F, 0.0F, in_c_.workspace(), in_c_.workspace_bytes(),
                            ignore, nullptr),
            DISFLOW_INVALID_CONFIG);
  const float point[3] = {0.0F, 0.0F, 0.0F};
  disflow_distance distance;
  EXPECT_EQ(disflow_query(in_c_.get(), point, 1, 0.0F, in_c_.workspace(), 100, &distance),
            DISFLOW_CAPACITY_EXCEEDED);
}

TEST(CModelOfNothing, HasNoSurfaceAndNoDistances) {
  TrackerInC empty;
  const float point[3] = {0.0F, 0.0F, 0.0F};
  disflow_distance distance;
  EXPECT_EQ(disflow_query(empty.get(), point, 1, 0.0F, empty.workspace(), empty.workspace_bytes(),
                          &distance),
            DISFLOW_NOT_INITIALISED);
  EXPECT_EQ(distance.status, DISFLOW_NOT_INITIALISED);
  const auto ignore = [](void*, const disflow_vertex*) { FAIL() << "called"; };
  EXPECT_EQ(disflow_surface(empty.get(), 0.0F, 0.0F, empty.workspace(), empty.workspace_bytes(),
                            ignore, nullptr),
            DISFLOW_NOT_INITIALISED);
  EXPECT_EQ(disflow_samples(empty.get(), nullptr, nullptr), 0);
}

}  // namespace
}  // namespace disflow::testing
