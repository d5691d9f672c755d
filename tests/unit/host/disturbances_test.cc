// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "disflow/host/motion.h"
#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"
#include "disflow/host/touching_hand.h"

namespace disflow::host {
namespace {

SimulationOptions Small(ObjectKind object = ObjectKind::kBottle) {
  SimulationOptions options;
  options.object = object;
  options.frames = 120;
  options.width_px = 320;
  options.height_px = 180;
  return options;
}

/// One image of a simulation.
struct Image {
  std::vector<float> depth_m;
  std::vector<bool> object;

  Image(const SimulationOptions& options, int index) {
    Simulation simulation(options, MakeObjectMesh(options.object));
    DepthFrame frame;
    simulation.Render(index, frame);
    depth_m.resize(static_cast<std::size_t>(frame.depth.width_px) *
                   static_cast<std::size_t>(frame.depth.height_px));
    std::memcpy(depth_m.data(), frame.depth.data, depth_m.size() * sizeof(float));
    const MaskView mask = simulation.gt_mask();
    for (std::size_t i = 0; i < depth_m.size(); ++i) object.push_back(mask.data[i] != 0);
  }
  [[nodiscard]] std::ptrdiff_t ObjectPixels() const {
    return std::count(object.begin(), object.end(), true);
  }
};

TEST(Curtain, HidesEverythingFromOneToOneAndAHalfSeconds) {
  SimulationOptions options = Small();
  options.occluder = OccluderKind::kCurtain;
  for (const int index : {0, 29, 45, 60}) EXPECT_GT(Image(options, index).ObjectPixels(), 500);
  for (const int index : {30, 37, 44}) {
    const Image image(options, index);
    EXPECT_EQ(image.ObjectPixels(), 0);
    EXPECT_LT(*std::max_element(image.depth_m.begin(), image.depth_m.end()), 0.31F);
  }
}

TEST(Hand, TouchesTheObjectAndHidesNothingOfIt) {
  SimulationOptions options = Small();
  options.motion = MotionKind::kStatic;
  const Image free(options, 45);
  options.occluder = OccluderKind::kHand;
  const Image touched(options, 45);
  std::ptrdiff_t hand_px = 0;
  for (std::size_t i = 0; i < free.depth_m.size(); ++i)
    hand_px += touched.depth_m[i] < free.depth_m[i] - 0.01F;
  EXPECT_GT(hand_px, 200);
  EXPECT_NEAR(static_cast<double>(touched.ObjectPixels()), static_cast<double>(free.ObjectPixels()),
              0.02 * static_cast<double>(free.ObjectPixels()));
}

TEST(Hand, MovesAlongWithTheObjectBetweenTouchAndRelease) {
  const TriangleMesh mesh = MakeObjectMesh(ObjectKind::kBox);
  const TouchingHand hand(mesh, Mat3d::Identity());
  const auto in_object = [&hand](double time_s) {
    // Wherever the object is.
    const Transform<Camera, Object, double> T_co(ExpSo3(Vec3d(0.2 * time_s, 0.5, 0.0)),
                                                 Vec3d(0.1, 0.1 * time_s, 0.7));
    return T_co.Inverse() * hand.PoseAt(time_s, T_co);
  };
  const Vec3d touch = in_object(TouchingHand::kTouch_s).translation();
  for (const double time_s : {1.3, 2.0, 3.0})
    EXPECT_LT((in_object(time_s).translation() - touch).norm(), 1e-9) << time_s;
  for (const double time_s : {0.5, 3.5})
    EXPECT_GT((in_object(time_s).translation() - touch).norm(), 0.15) << time_s;
  // Its tip is at the surface, not inside of the object.
  double farthest_m = 0.0;
  for (const Vec3d& vertex : mesh.vertices) farthest_m = std::max(farthest_m, vertex.x());
  EXPECT_NEAR(touch.x(), farthest_m, 1e-9);
}

TEST(Table, CarriesTheObjectUntilItIsLiftedOff) {
  SimulationOptions options = Small(ObjectKind::kBox);
  options.motion = MotionKind::kStatic;
  const Image free(options, 0);
  options.support = SupportKind::kTable;
  const Image standing(options, 0);
  EXPECT_NEAR(static_cast<double>(standing.ObjectPixels()),
              static_cast<double>(free.ObjectPixels()),
              0.02 * static_cast<double>(free.ObjectPixels()));
  std::ptrdiff_t table_px = 0;
  float gap_m = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < free.depth_m.size(); ++i) {
    const bool is_table = standing.depth_m[i] < free.depth_m[i] - 0.01F;
    table_px += is_table ? 1 : 0;
    if (i > 0 && is_table && standing.object[i - 1])
      gap_m = std::min(gap_m, std::abs(standing.depth_m[i] - standing.depth_m[i - 1]));
  }
  EXPECT_GT(table_px, 3000);
  EXPECT_LT(gap_m, 0.02F);  // somewhere object and table meet
  const Image lifted(options, 60);
  std::ptrdiff_t lower = 0;
  for (std::size_t i = 0; i < free.depth_m.size(); ++i)
    lower += lifted.depth_m[i] > standing.depth_m[i] + 0.05F;
  EXPECT_GT(lower, 1000);
}

TEST(Leaving, ObjectGoesOutOfViewAndComesBackToWhereItWas) {
  SimulationOptions options = Small(ObjectKind::kBox);
  options.motion = MotionKind::kLeaving;
  EXPECT_GT(Image(options, 0).ObjectPixels(), 500);
  EXPECT_EQ(Image(options, 51).ObjectPixels(), 0);
  EXPECT_GT(Image(options, 100).ObjectPixels(), 500);
  MotionSettings settings;
  settings.kind = MotionKind::kLeaving;
  const auto motion = MakeObjectMotion(settings);
  EXPECT_LT((motion->At(3.3).pose.translation() - motion->At(0.0).pose.translation()).norm(), 1e-9);
}

TEST(Leaving, Velocities_AreTheDerivativesOfThePoses) {
  MotionSettings settings;
  settings.kind = MotionKind::kLeaving;
  settings.start_rotation = ExpSo3(Vec3d(0.4, 1.0, -0.3));
  const auto motion = MakeObjectMotion(settings);
  constexpr double kStep_s = 1e-5;
  for (double time_s = 0.1; time_s < 3.5; time_s += 0.13) {
    const auto before = motion->At(time_s - kStep_s).pose;
    const auto after = motion->At(time_s + kStep_s).pose;
    const Vec3d v = (after.translation() - before.translation()) / (2.0 * kStep_s);
    const Vec3d w = TurnBetween(before.rotation(), after.rotation()) / (2.0 * kStep_s);
    EXPECT_LT((v - motion->At(time_s).linear_mps).norm(), 1e-5) << time_s;
    EXPECT_LT((w - motion->At(time_s).angular_rps).norm(), 1e-5) << time_s;
  }
}

}  // namespace
}  // namespace disflow::host
