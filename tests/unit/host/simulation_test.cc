// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <tuple>
#include <vector>

#include "box_ray.h"
#include "disflow/host/simulated_shapes.h"
#include "disflow/host/stereo_camera.h"

namespace disflow::host {
namespace {

const Vec3d kBoxHalf(0.082, 0.036, 0.1065);

SimulationOptions Small(MotionKind motion = MotionKind::kFast) {
  SimulationOptions options;
  options.motion = motion;
  options.frames = 40;
  options.width_px = 320;
  options.height_px = 180;
  return options;
}

Simulation Make(const SimulationOptions& options) {
  return {options, MakeObjectMesh(options.object)};
}

std::vector<float> DepthOf(const DepthFrame& frame) {
  const std::size_t pixels = static_cast<std::size_t>(frame.depth.width_px) *
                             static_cast<std::size_t>(frame.depth.height_px);
  std::vector<float> depth_m(pixels);
  std::memcpy(depth_m.data(), frame.depth.data, pixels * sizeof(float));
  return depth_m;
}

std::ptrdiff_t PixelsOf(const MaskView& mask) {
  return std::count(mask.data, mask.data + mask.width_px * mask.height_px, 255);
}

Vec3d RayOf(const DepthFrame& frame, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(frame.depth.width_px);
  return frame.camera.Ray(static_cast<float>(pixel % width), static_cast<float>(pixel / width))
      .cast<double>();
}

TEST(Simulation, DepthAndMask_AreThoseOfTheTruePose) {
  Simulation simulation = Make(Small());
  for (const int index : {0, 17, 39}) {
    DepthFrame frame;
    simulation.Render(index, frame);
    const auto T_co = simulation.TruthAt(index).object.pose;
    const std::vector<float> depth_m = DepthOf(frame);
    for (std::size_t pixel = 0; pixel < depth_m.size(); ++pixel) {
      const Vec3d ray = RayOf(frame, pixel);
      const Vec3d sliver = Vec3d::Constant(1e-6);
      const auto inner = BoxDepth(kBoxHalf - sliver, T_co, ray);
      const auto outer = BoxDepth(kBoxHalf + sliver, T_co, ray);
      if (inner.has_value() != outer.has_value()) continue;  // on the very outline
      ASSERT_EQ(frame.mask.data[pixel], outer ? 255 : 0) << "frame " << index;
      if (outer) {
        ASSERT_NEAR(static_cast<double>(depth_m[pixel]), *outer, 1e-5);
      }
    }
  }
}

TEST(Simulation, Background_IsBehindTheObjectEverywhere) {
  Simulation simulation = Make(Small());
  DepthFrame frame;
  simulation.Render(20, frame);
  const std::vector<float> depth_m = DepthOf(frame);
  for (std::size_t pixel = 0; pixel < depth_m.size(); ++pixel) {
    if (frame.mask.data[pixel] == 0) {
      ASSERT_GT(depth_m[pixel], 0.9F);
    }
  }
}

TEST(Simulation, SameOptions_GiveTheSameBytesInAnyOrder) {
  for (const NoiseKind noise : {NoiseKind::kClean, NoiseKind::kWhite, NoiseKind::kD415,
                                NoiseKind::kKinect, NoiseKind::kTof, NoiseKind::kStereo}) {
    if (noise == NoiseKind::kStereo && !StereoIsAvailable()) continue;
    SimulationOptions options = Small();
    options.noise = noise;
    Simulation first = Make(options);
    Simulation second = Make(options);
    DepthFrame a;
    DepthFrame b;
    first.Render(3, a);
    first.Render(11, a);
    second.Render(11, b);
    EXPECT_EQ(DepthOf(a), DepthOf(b));
    EXPECT_EQ(std::memcmp(a.mask.data, b.mask.data, 320 * 180), 0);
    EXPECT_EQ(a.stamp_ns, b.stamp_ns);
  }
}

TEST(Simulation, OtherSeed_GivesAnotherSequence) {
  SimulationOptions options = Small();
  const Vec3d here = Make(options).TruthAt(30).object.pose.translation();
  options.seed = 2;
  EXPECT_GT((Make(options).TruthAt(30).object.pose.translation() - here).norm(), 1e-3);
}

/// A parameter that says what it is.
template <class Kind>
struct Named {
  const char* name;
  Kind kind;

  friend void PrintTo(const Named& named, std::ostream* stream) { *stream << named.name; }
};

class ObjectInView : public testing::TestWithParam<
                         std::tuple<Named<ObjectKind>, Named<MotionKind>, Named<CameraKind>>> {};

TEST_P(ObjectInView, WholeObject_StaysInsideOfTheImage) {
  const auto [object, motion, camera] = GetParam();
  SimulationOptions options = Small(motion.kind);
  options.object = object.kind;
  options.camera = camera.kind;
  options.frames = 300;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    options.seed = seed;
    const Simulation simulation = Make(options);
    for (int index = 0; index < options.frames; index += 3) {
      const auto T_co = simulation.TruthAt(index).object.pose;
      ASSERT_GT(T_co.translation().z(), 0.5);
      ASSERT_LT(T_co.translation().z(), 1.0);
      for (const Vec3d& vertex : simulation.mesh().vertices) {
        const Vec2 pixel = simulation.camera().Project((T_co * vertex).cast<float>());
        ASSERT_TRUE(pixel.x() > 0.0F && pixel.x() < 319.0F && pixel.y() > 0.0F &&
                    pixel.y() < 179.0F)
            << "frame " << index << " seed " << seed << ": " << pixel.transpose();
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ObjectInView,
    testing::Combine(testing::Values(Named<ObjectKind>{"Box", ObjectKind::kBox},
                                     Named<ObjectKind>{"Can", ObjectKind::kCan}),
                     testing::Values(Named<MotionKind>{"Fast", MotionKind::kFast},
                                     Named<MotionKind>{"Rotate360", MotionKind::kRotate360},
                                     Named<MotionKind>{"Flying", MotionKind::kFlying}),
                     testing::Values(Named<CameraKind>{"StaticCamera", CameraKind::kStatic},
                                     Named<CameraKind>{"MovingCamera", CameraKind::kMoving})),
    [](const auto& test) {
      return std::string(std::get<0>(test.param).name) + std::get<1>(test.param).name +
             std::get<2>(test.param).name;
    });

TEST(MovingCamera, Twist_IsTheDerivativeOfTheRelativePose) {
  SimulationOptions options = Small();
  options.camera = CameraKind::kMoving;
  options.fps = 10000.0;  // so that neighbouring frames make a derivative
  options.frames = 30000;
  const Simulation simulation = Make(options);
  for (int index = 5000; index < options.frames; index += 997) {
    const auto before = simulation.TruthAt(index - 1).object.pose;
    const auto after = simulation.TruthAt(index + 1).object.pose;
    const auto state = simulation.TruthAt(index).object;
    const Vec3d v = (after.translation() - before.translation()) * 0.5 * options.fps;
    const Vec3d w = TurnBetween(before.rotation(), after.rotation()) * 0.5 * options.fps;
    ASSERT_LT((v - state.linear_mps).norm(), 1e-5);
    ASSERT_LT((w - state.angular_rps).norm(), 1e-4);
  }
}

TEST(MovingCamera, Background_StaysWhereItIsInTheWorld) {
  SimulationOptions options = Small(MotionKind::kStatic);
  options.camera = CameraKind::kMoving;
  options.frames = 200;
  Simulation simulation = Make(options);
  DepthFrame frame;
  simulation.Render(0, frame);
  ASSERT_TRUE(frame.has_T_wc);
  EXPECT_LT((frame.T_wc.rotation() - Mat3::Identity()).norm(), 1e-6F);
  EXPECT_LT(frame.T_wc.translation().norm(), 1e-6F);
  // The wall as seen first: 0.25 x + z = d in the world.
  const auto on_wall = [](const Vec3d& x) { return 0.25 * x.x() + x.z(); };
  const double wall = on_wall(RayOf(frame, 0) * static_cast<double>(DepthOf(frame)[0]));
  double moved_m = 0.0;
  for (const int index : {60, 120, 199}) {
    simulation.Render(index, frame);
    const Transform<World, Camera, double> T_wc = frame.T_wc.Cast<double>();
    const double depth_m = static_cast<double>(DepthOf(frame)[0]);
    EXPECT_NEAR(on_wall(T_wc * Vec3d(RayOf(frame, 0) * depth_m)), wall, 1e-5);
    moved_m = std::max(moved_m, T_wc.translation().norm());
  }
  EXPECT_GT(moved_m, 0.02);
}

TEST(MovingCamera, RestingObject_RestsInTheWorld) {
  SimulationOptions options = Small(MotionKind::kStatic);
  options.camera = CameraKind::kMoving;
  const Simulation simulation = Make(options);
  const FrameTruth start = simulation.TruthAt(0);
  const FrameTruth end = simulation.TruthAt(39);
  const auto T_wo_start = start.camera.pose * start.object.pose;
  const auto T_wo_end = end.camera.pose * end.object.pose;
  EXPECT_LT((T_wo_start.translation() - T_wo_end.translation()).norm(), 1e-12);
  EXPECT_GT((start.object.pose.translation() - end.object.pose.translation()).norm(), 1e-3);
}

TEST(Arm, HidesUpToHalfOfTheObjectAndLeavesTheFirstFrameFree) {
  for (const ObjectKind object : {ObjectKind::kBox, ObjectKind::kBottle}) {
    SimulationOptions options = Small();
    options.object = object;
    options.frames = 150;
    Simulation free = Make(options);
    options.occluder = OccluderKind::kArm;
    Simulation occluded = Make(options);
    double most = 0.0;
    int disturbed = 0;
    for (int index = 0; index < options.frames; ++index) {
      DepthFrame frame;
      free.Render(index, frame);
      const auto all = static_cast<double>(PixelsOf(frame.mask));
      occluded.Render(index, frame);
      const double hidden = 1.0 - static_cast<double>(PixelsOf(frame.mask)) / all;
      if (index == 0) {
        EXPECT_EQ(hidden, 0.0);
      }
      most = std::max(most, hidden);
      if (hidden > 0.1) ++disturbed;
    }
    EXPECT_GT(most, 0.3);
    EXPECT_LT(most, 0.65);
    EXPECT_GT(disturbed, 20);
  }
}

TEST(Masks, SetNone_GivesNoneAndSloppyGivesAnother) {
  SimulationOptions options = Small();
  options.mask = MaskKind::kNone;
  DepthFrame frame;
  Simulation none = Make(options);
  none.Render(0, frame);
  EXPECT_FALSE(frame.mask.given());
  EXPECT_GT(PixelsOf(none.gt_mask()), 500);
  options.mask = MaskKind::kSloppy;
  Simulation sloppy = Make(options);
  sloppy.Render(0, frame);
  EXPECT_GT(PixelsOf(frame.mask), PixelsOf(sloppy.gt_mask()));
}

TEST(Z16, DepthIsInWholeMillimetres) {
  SimulationOptions options = Small();
  Simulation exact = Make(options);
  options.format = DepthFormat::kUint16;
  Simulation rounded = Make(options);
  DepthFrame a;
  DepthFrame b;
  exact.Render(7, a);
  rounded.Render(7, b);
  ASSERT_EQ(b.depth.format, DepthFormat::kUint16);
  ASSERT_EQ(b.depth.stride_bytes, 2 * b.depth.width_px);
  const std::vector<float> depth_m = DepthOf(a);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    std::uint16_t raw = 0;
    std::memcpy(&raw, static_cast<const std::byte*>(b.depth.data) + 2 * i, sizeof(raw));
    ASSERT_NEAR(static_cast<float>(raw) * b.depth.unit_m, depth_m[i], 5.1e-4F);
  }
}

TEST(Size, AnySize_IsRendered) {
  for (const auto& [width, height] : {std::pair{1280, 720}, {64, 64}, {33, 47}}) {
    SimulationOptions options = Small();
    options.width_px = width;
    options.height_px = height;
    Simulation simulation = Make(options);
    DepthFrame frame;
    simulation.Render(1, frame);
    EXPECT_EQ(CheckFrame(frame, 4096, 4096), Status::kOk);
    EXPECT_GT(PixelsOf(frame.mask), 20);
  }
}

}  // namespace
}  // namespace disflow::host
