// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/distance_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"

namespace disflow::testing {
namespace {

class FlowCollector final : public FlowSink {
 public:
  std::vector<FlowSample> samples;

 private:
  void DoOnSample(const FlowSample& sample) noexcept override { samples.push_back(sample); }
};

/// A simulated object in known motion, tracked.
class DistanceFlow : public ::testing::Test {
 protected:
  void Track(host::NoiseKind noise, int frames) {
    host::SimulationOptions options;
    options.object = host::ObjectKind::kBottle;
    options.motion = host::MotionKind::kFast;
    options.noise = noise;
    options.mask = host::MaskKind::kGt;
    options.frames = frames;
    host::Simulation simulation(options, host::MakeObjectMesh(options.object));
    DepthFrame frame;
    for (int i = 0; i < frames; ++i) {
      simulation.Render(i, frame);
      (void)tracker->Process(frame, estimate);
    }
    ASSERT_EQ(estimate.status, Status::kOk);
    ASSERT_EQ(StreamFlow(*tracker, estimate, flow), estimate.samples);
    ASSERT_EQ(flow.samples.size(), estimate.samples);
    truth = simulation.TruthAt(frames - 1).object;
  }

  std::unique_ptr<Tracker<profiles::Edge>> tracker = std::make_unique<Tracker<profiles::Edge>>();
  Estimate estimate;
  FlowCollector flow;
  host::RigidState<Camera, Object> truth;
};

TEST_F(DistanceFlow, KnownMotion_FlowIsTheVelocityOfEachPoint) {
  Track(host::NoiseKind::kClean, 40);
  double sum_squared = 0.0;
  double true_squared = 0.0;
  for (const FlowSample& sample : flow.samples) {
    const host::Vec3d x_m = sample.position_m.cast<double>();
    const host::Vec3d velocity_mps =
        truth.linear_mps + truth.angular_rps.cross(x_m - truth.pose.translation());
    sum_squared += (sample.flow_mps.cast<double>() - velocity_mps).squaredNorm();
    true_squared += velocity_mps.squaredNorm();
  }
  const auto count = static_cast<double>(flow.samples.size());
  EXPECT_GT(std::sqrt(true_squared / count), 0.1) << "the motion is worth measuring";
  EXPECT_LT(std::sqrt(sum_squared / count), 0.02);
}

TEST_F(DistanceFlow, RegisteredFrame_PointsLieOnTheModelAndGradientsAreNormals) {
  Track(host::NoiseKind::kWhite, 20);
  double sum_squared_m2 = 0.0;
  int matched = 0;
  for (const FlowSample& sample : flow.samples) {
    if (std::isnan(sample.distance_m)) {
      EXPECT_TRUE(sample.gradient.isZero());
      continue;
    }
    ++matched;
    sum_squared_m2 += static_cast<double>(sample.distance_m * sample.distance_m);
    EXPECT_GT(sample.gradient.dot(sample.normal), 0.5F);
    EXPECT_LT(sample.normal.dot(sample.position_m), 0.0F) << "towards the camera";
  }
  EXPECT_GT(matched, static_cast<int>(flow.samples.size()) * 9 / 10);
  EXPECT_LT(std::sqrt(sum_squared_m2 / matched), 1.5e-3);
}

TEST_F(DistanceFlow, PointsInFrontOfTheModel_HavePositiveDistance) {
  Track(host::NoiseKind::kClean, 10);
  constexpr float kShift_m = 0.002F;
  Estimate behind = estimate;
  behind.T_co = PoseCameraFromObject(estimate.T_co.rotation(),
                                     Vec3(estimate.T_co.translation() + kShift_m * Vec3::UnitZ()));
  FlowCollector shifted;
  ASSERT_GT(StreamFlow(*tracker, behind, shifted), 300);
  int checked = 0;
  int right = 0;
  for (const FlowSample& sample : shifted.samples) {
    // The model moved away from the camera, by this much along the normal.
    const float expected_m = -kShift_m * sample.normal.z();
    if (std::isnan(sample.distance_m) || expected_m < 0.001F) continue;
    ++checked;
    if (std::abs(sample.distance_m - expected_m) < 0.0005F) ++right;
  }
  EXPECT_GT(checked, 200);
  // Where the model curves or ends, moving it is not the same as moving a plane.
  EXPECT_GT(right, checked * 9 / 10);
}

TEST_F(DistanceFlow, RefusedFrame_HasNoFlow) {
  Track(host::NoiseKind::kClean, 3);
  FlowCollector none;
  EXPECT_NE(tracker->Process(DepthFrame{}, estimate), Status::kOk);
  EXPECT_EQ(StreamFlow(*tracker, estimate, none), 0);
  EXPECT_TRUE(none.samples.empty());
}

}  // namespace
}  // namespace disflow::testing
