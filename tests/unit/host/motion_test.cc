// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "disflow/host/simulation.h"

namespace disflow::host {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kFrame_s = 1.0 / 30.0;

struct MotionCase {
  const char* name;
  MotionKind kind;
  double peak_mps;
  double peak_rps;
};

void PrintTo(const MotionCase& motion, std::ostream* stream) { *stream << motion.name; }

MotionSettings SettingsOf(MotionKind kind, std::uint64_t seed) {
  MotionSettings settings;
  settings.kind = kind;
  settings.workspace = {Vec3d(0.0, 0.0, 0.73), Vec3d(0.16, 0.04, 0.12)};
  settings.start_rotation = ExpSo3(Vec3d(0.4, 1.0, -0.3));
  settings.seed = seed;
  return settings;
}

class Motion : public testing::TestWithParam<MotionCase> {};

TEST_P(Motion, Velocities_AreTheDerivativesOfThePoses) {
  const auto motion = MakeObjectMotion(SettingsOf(GetParam().kind, 3));
  constexpr double kStep_s = 1e-5;
  for (int frame = 1; frame < 300; ++frame) {
    const double time_s = frame * kFrame_s;
    const auto before = motion->At(time_s - kStep_s).pose;
    const auto after = motion->At(time_s + kStep_s).pose;
    const auto state = motion->At(time_s);
    const Vec3d v = (after.translation() - before.translation()) / (2.0 * kStep_s);
    const Vec3d w = TurnBetween(before.rotation(), after.rotation()) / (2.0 * kStep_s);
    ASSERT_LT((v - state.linear_mps).norm(), 1e-5) << "frame " << frame;
    ASSERT_LT((w - state.angular_rps).norm(), 1e-5) << "frame " << frame;
  }
}

TEST_P(Motion, Peaks_AreAsPromised) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    const auto motion = MakeObjectMotion(SettingsOf(GetParam().kind, seed));
    double peak_mps = 0.0;
    double peak_rps = 0.0;
    for (int frame = 0; frame < 300; ++frame) {
      const auto state = motion->At(frame * kFrame_s);
      peak_mps = std::max(peak_mps, state.linear_mps.norm());
      peak_rps = std::max(peak_rps, state.angular_rps.norm());
    }
    EXPECT_NEAR(peak_mps, GetParam().peak_mps, 0.12 * GetParam().peak_mps) << "seed " << seed;
    EXPECT_NEAR(peak_rps, GetParam().peak_rps, 0.12 * GetParam().peak_rps) << "seed " << seed;
  }
}

TEST_P(Motion, StartsAtRestInTheGivenRotation) {
  const MotionSettings settings = SettingsOf(GetParam().kind, 2);
  const auto state = MakeObjectMotion(settings)->At(0.0);
  EXPECT_EQ(state.linear_mps.norm(), 0.0);
  EXPECT_EQ(state.angular_rps.norm(), 0.0);
  EXPECT_LT((state.pose.rotation() - settings.start_rotation).norm(), 1e-12);
}

TEST_P(Motion, Origin_StaysInTheWorkspace) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const MotionSettings settings = SettingsOf(GetParam().kind, seed);
    const auto motion = MakeObjectMotion(settings);
    for (int i = 0; i < 1000; ++i) {
      const Vec3d offset = motion->At(0.01 * i).pose.translation() - settings.workspace.centre_m;
      ASSERT_TRUE((offset.cwiseAbs() - settings.workspace.half_extent_m).maxCoeff() < 1e-9)
          << offset.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Motion,
    testing::Values(MotionCase{"Static", MotionKind::kStatic, 0.0, 0.0},
                    MotionCase{"Moderate", MotionKind::kModerate, 0.2, 90.0 * kRadPerDeg},
                    MotionCase{"Fast", MotionKind::kFast, 0.6, 270.0 * kRadPerDeg},
                    MotionCase{"Flying", MotionKind::kFlying, 1.2, 500.0 * kRadPerDeg}),
    [](const auto& test) { return test.param.name; });

TEST(Rotate360, TurnsOnceAboutANearlyVerticalAxisAndComesBack) {
  const auto motion = MakeObjectMotion(SettingsOf(MotionKind::kRotate360, 1));
  const auto start = motion->At(0.0).pose;
  const auto end = motion->At(9.9).pose;
  EXPECT_LT((start.rotation() - end.rotation()).norm(), 1e-9);
  EXPECT_LT((start.translation() - end.translation()).norm(), 1e-9);
  double turned_rad = 0.0;
  constexpr double kStep_s = 0.001;
  for (int i = 0; i < 10000; ++i) {
    const Vec3d w = motion->At((i + 0.5) * kStep_s).angular_rps;
    turned_rad += w.norm() * kStep_s;
    if (w.norm() > 1e-6) {
      ASSERT_GT(std::abs(w.normalized().y()), 0.95);
    }
  }
  EXPECT_NEAR(turned_rad, 2.0 * std::numbers::pi, 1e-4);
}

TEST(Fast, TurnsNewSidesIntoView) {
  const auto motion = MakeObjectMotion(SettingsOf(MotionKind::kFast, 1));
  double largest_rad = 0.0;
  const Mat3d start = motion->At(0.0).pose.rotation();
  for (int i = 0; i < 300; ++i) {
    const Mat3d rotation = motion->At(i * kFrame_s).pose.rotation();
    largest_rad = std::max(largest_rad, TurnBetween(start, rotation).norm());
  }
  EXPECT_GT(largest_rad, 90.0 * kRadPerDeg);
}

TEST(Flying, VelocityJumps_ComeHalfWayBetweenFrames) {
  const auto motion = MakeObjectMotion(SettingsOf(MotionKind::kFlying, 1));
  int jumps = 0;
  for (int frame = 0; frame < 299; ++frame) {
    const double time_s = frame * kFrame_s;
    const Vec3d here = motion->At(time_s).linear_mps;
    const Vec3d next = motion->At(time_s + kFrame_s).linear_mps;
    // Constant up to the middle, constant after it.
    ASSERT_LT((motion->At(time_s + 0.49 * kFrame_s).linear_mps - here).norm(), 1e-12);
    ASSERT_LT((motion->At(time_s + 0.51 * kFrame_s).linear_mps - next).norm(), 1e-12);
    if ((next - here).norm() > 0.5) ++jumps;
  }
  EXPECT_GT(jumps, 30);
}

TEST(FitWorkspace, SphereAnywhereInIt_IsInsideOfTheImage) {
  for (const double radius_m : {0.05, 0.139, 0.4}) {
    const PinholeCamera camera = SimulatedCamera({});
    const Workspace space = FitWorkspace(camera, 640, 360, radius_m);
    EXPECT_GT(space.half_extent_m.minCoeff(), 0.02);
    const auto reaches = [&](double aside_m, double focal_px) {
      // The image of a sphere's edge, seen from the side.
      const double depth_m = space.centre_m.z() - space.half_extent_m.z();
      const double angle =
          std::atan2(aside_m, depth_m) + std::asin(radius_m / std::hypot(aside_m, depth_m));
      return focal_px * std::tan(angle);
    };
    EXPECT_LT(reaches(space.half_extent_m.x(), 614.715), 318.0);
    EXPECT_LT(reaches(space.half_extent_m.y(), 614.715), 178.0);
  }
}

TEST(FitWorkspace, OfADistance_IsNoNearer) {
  const PinholeCamera camera = SimulatedCamera({});
  const Workspace space = FitWorkspace(camera, 640, 360, 0.1, 1.5);
  EXPECT_NEAR(space.centre_m.z() - space.half_extent_m.z(), 1.5, 1e-12);
  const Workspace near = FitWorkspace(camera, 640, 360, 0.1, 0.1);
  EXPECT_EQ(near.centre_m.z(), FitWorkspace(camera, 640, 360, 0.1).centre_m.z());
}

TEST(StackWorkspaces, OfADistance_BeginThere) {
  const PinholeCamera camera = SimulatedCamera({});
  const std::vector<Workspace> spaces =
      StackWorkspaces(camera, 640, 360, std::vector<double>{0.1, 0.05}, 1.5);
  EXPECT_NEAR(spaces[0].centre_m.z() - spaces[0].half_extent_m.z(), 1.5, 1e-12);
  EXPECT_GT(spaces[1].centre_m.z(), spaces[0].centre_m.z() + 0.1);
}

}  // namespace
}  // namespace disflow::host
