// SPDX-License-Identifier: BSD-3-Clause
#include "icp_tracker.h"

#include <gtest/gtest.h>

#include "disflow/config.h"
#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"

namespace disflow::bench {
namespace {

constexpr int kFrames = 22;
constexpr double kDegree = 0.0174532925199432957;

host::Simulation BoxInMotion() {
  host::SimulationOptions options;
  options.object = host::ObjectKind::kBox;
  options.motion = host::MotionKind::kModerate;
  options.frames = kFrames;
  return {options, host::MakeObjectMesh(options.object)};
}

/// Coarse, so that the test is quick.
IcpSettings Coarse(IcpKind kind) {
  IcpSettings settings;
  settings.kind = kind;
  settings.voxel_m = 0.005F;
  settings.flatness = 0.01;
  return settings;
}

struct Error {
  double translation_m = 0.0;
  double rotation_rad = 0.0;
  double linear_mps = 0.0;
};

/// Of every frame, with the object frames brought together at the first.
std::vector<Error> ErrorsOf(IcpKind kind) {
  host::Simulation simulation = BoxInMotion();
  IcpTracker tracker(Coarse(kind));
  std::vector<Error> errors;
  Transform<Object, Object, double> T_ot;
  for (int i = 0; i < kFrames; ++i) {
    DepthFrame frame;
    simulation.Render(i, frame);
    Estimate estimate;
    tracker.Process(frame, estimate);
    EXPECT_EQ(estimate.status, Status::kOk) << "frame " << i;
    const auto truth = simulation.TruthAt(i).object;
    const auto T_co = estimate.T_co.Cast<double>();
    if (i == 0) T_ot = T_co.Inverse() * truth.pose;
    const auto T_ct = T_co * T_ot;
    const host::Vec3d lever = truth.pose.translation() - T_co.translation();
    const host::Vec3d angular = estimate.twist.angular_rps.cast<double>();
    const host::Vec3d linear = estimate.twist.linear_mps.cast<double>() + angular.cross(lever);
    errors.push_back({(T_ct.translation() - truth.pose.translation()).norm(),
                      TurnBetween<double>(truth.pose.rotation(), T_ct.rotation()).norm(),
                      (linear - truth.linear_mps).norm()});
  }
  return errors;
}

class IcpTrackerOfBothKinds : public testing::TestWithParam<IcpKind> {};

TEST_P(IcpTrackerOfBothKinds, CleanImagesOfABox_AreRegisteredToWithinAMillimetre) {
  const std::vector<Error> errors = ErrorsOf(GetParam());
  host::Simulation simulation = BoxInMotion();
  const auto place = [&](int i) { return simulation.TruthAt(i).object.pose.translation(); };
  ASSERT_GT((place(kFrames - 1) - place(0)).norm(), 0.02) << "it hardly moves";
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_LT(errors[i].translation_m, 0.001) << "frame " << i;
    EXPECT_LT(errors[i].rotation_rad, 0.5 * kDegree) << "frame " << i;
  }
}

TEST_P(IcpTrackerOfBothKinds, VelocityIsThatOfTheObject) {
  const std::vector<Error> errors = ErrorsOf(GetParam());
  for (std::size_t i = 2; i < errors.size(); ++i) EXPECT_LT(errors[i].linear_mps, 0.03) << i;
}

INSTANTIATE_TEST_SUITE_P(, IcpTrackerOfBothKinds,
                         testing::Values(IcpKind::kGeneralised, IcpKind::kPointToPlane),
                         [](const auto& kind) {
                           return kind.param == IcpKind::kGeneralised ? "Generalised"
                                                                      : "PointToPlane";
                         });

TEST(IcpTracker, ObjectThatIsNotSeen_IsPredictedAndCalledLost) {
  host::Simulation simulation = BoxInMotion();
  IcpTracker tracker(Coarse(IcpKind::kPointToPlane));
  constexpr int kFirst = 14;  // it starts from rest; by then it moves
  DepthFrame frame;
  Estimate before;
  for (int i = 0; i < 3; ++i) {
    simulation.Render(kFirst + i, frame);
    tracker.Process(frame, before);
  }
  simulation.Render(kFirst + 3, frame);
  const std::vector<std::uint8_t> nothing(
      static_cast<std::size_t>(frame.mask.stride_bytes * frame.mask.height_px));
  frame.mask.data = nothing.data();
  Estimate estimate;
  tracker.Process(frame, estimate);
  EXPECT_EQ(estimate.state, TrackingState::kLost);
  EXPECT_NE(estimate.status, Status::kOk);
  // On, and as fast as before.
  const float step_m = (estimate.T_co.translation() - before.T_co.translation()).norm();
  EXPECT_NEAR(step_m, before.twist.linear_mps.norm() / 30.0F, 1e-4F);
  EXPECT_GT(step_m, 1e-4F);
}

TEST(ObjectCloud, BorderOfTheMask_IsLeftOut) {
  host::Simulation simulation = BoxInMotion();
  DepthFrame frame;
  simulation.Render(0, frame);
  // A mask of 40 x 30 pixels in the middle of the object, of which the tracker's border goes.
  const auto border_px = static_cast<float>(Config{}.sampler.border_px);
  ASSERT_GT(border_px, 0.0F);
  const auto pixels = static_cast<std::size_t>(frame.mask.stride_bytes * frame.mask.height_px);
  std::vector<std::uint8_t> square(pixels);
  const Vec3 middle = simulation.TruthAt(0).object.pose.translation().cast<float>();
  const Vec2 px = frame.camera.Project(middle);
  const int u_begin = static_cast<int>(px.x()) - 20;
  const int v_begin = static_cast<int>(px.y()) - 15;
  for (int v = v_begin; v < v_begin + 30; ++v) {
    for (int u = u_begin; u < u_begin + 40; ++u)
      square[static_cast<std::size_t>(v * frame.mask.stride_bytes + u)] = 255;
  }
  frame.mask.data = square.data();
  const Cloud::Ptr cloud = MakeObjectCloud(frame, IcpSettings{});
  ASSERT_GT(cloud->size(), 50U);
  for (const pcl::PointNormal& point : *cloud) {
    const Vec2 seen = frame.camera.Project(point.getVector3fMap());
    EXPECT_GT(seen.x(), static_cast<float>(u_begin) + border_px - 0.1F);
    EXPECT_LT(seen.x(), static_cast<float>(u_begin) + 39.1F - border_px);
    EXPECT_GT(seen.y(), static_cast<float>(v_begin) + border_px - 0.1F);
    EXPECT_LT(seen.y(), static_cast<float>(v_begin) + 29.1F - border_px);
    EXPECT_LT(point.getNormalVector3fMap().dot(point.getVector3fMap()), 0.0F);
  }
}

}  // namespace
}  // namespace disflow::bench
