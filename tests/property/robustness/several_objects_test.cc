// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"
#include "disflow/surface_extractor.h"
#include "disflow/tracker_group.h"

namespace disflow {
namespace {

using Group = TrackerGroup<profiles::Edge, 2>;
using host::Vec3d;

host::SimulationOptions BoxBeforeBottle(int frames) {
  host::SimulationOptions options;
  options.frames = frames;
  options.motion = host::MotionKind::kModerate;
  EXPECT_TRUE(SetSimulationObject("box+bottle", options).ok());
  return options;
}

host::Simulation Make(const host::SimulationOptions& options) {
  return {options, std::vector{host::MakeObjectMesh(host::ObjectKind::kBox),
                               host::MakeObjectMesh(host::ObjectKind::kBottle)}};
}

Transform<Camera, Object, double> PoseOf(const Estimate& estimate) {
  return {estimate.T_co.rotation().cast<double>(),
          Vec3d(estimate.T_co.translation().cast<double>())};
}

/// How far the model's samples are from a point of the object frame at most.
class FarthestSample final : public SampleSink {
 public:
  explicit FarthestSample(const Vec3d& centre_o) : centre_o_(centre_o) {}
  [[nodiscard]] double distance_m() const { return distance_m_; }

 private:
  void DoOnSample(const SurfaceVertex& sample, int /*observations*/) noexcept override {
    distance_m_ = std::max(distance_m_, (sample.position_m.cast<double>() - centre_o_).norm());
  }
  Vec3d centre_o_;
  double distance_m_ = 0.0;
};

void ExpectSame(const Estimate& a, const Estimate& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.T_co.translation(), b.T_co.translation());
  EXPECT_EQ(a.T_co.rotation(), b.T_co.rotation());
  EXPECT_EQ(a.pose_covariance, b.pose_covariance);
  EXPECT_EQ(a.samples, b.samples);
}

TEST(SeveralObjects, InAGroup_GiveWhatEachGivesAlone) {
  host::Simulation simulation = Make(BoxBeforeBottle(60));
  const auto group = std::make_unique<Group>(
      Group::Objects{{{.config = {}, .mask_label = 1}, {.config = {}, .mask_label = 2}}});
  const auto alone = std::make_unique<Tracker<profiles::Edge>>();
  for (int i = 0; i < 60; ++i) {
    DepthFrame frame;
    simulation.Render(i, frame);
    Group::Estimates estimates;
    group->Process(frame, estimates);
    // The bottle of the group and a mask of the bottle only.
    std::vector<std::uint8_t> bottle(frame.mask.data, frame.mask.data + 640 * 360);
    for (std::uint8_t& value : bottle) value = value == 2 ? 255 : 0;
    frame.mask.data = bottle.data();
    Estimate estimate;
    (void)alone->Process(frame, estimate);
    ExpectSame(estimates[1], estimate);
    EXPECT_EQ(estimates[0].status, Status::kOk);
  }
}

TEST(SeveralObjects, LostOne_DisturbsNoOther) {
  host::SimulationOptions options = BoxBeforeBottle(90);
  const auto track = [&options] {
    host::Simulation simulation = Make(options);
    const auto group = std::make_unique<Group>(
        Group::Objects{{{.config = {}, .mask_label = 1}, {.config = {}, .mask_label = 2}}});
    std::vector<Group::Estimates> all(90);
    for (int i = 0; i < 90; ++i) {
      DepthFrame frame;
      simulation.Render(i, frame);
      group->Process(frame, all[static_cast<std::size_t>(i)]);
    }
    return all;
  };
  const auto usual = track();
  options.hide = 2;  // the farther one, so that the pixels of the nearer are the same
  const auto hidden = track();
  for (std::size_t i = 0; i < usual.size(); ++i) ExpectSame(usual[i][0], hidden[i][0]);
  EXPECT_EQ(hidden[45][1].status, Status::kEmptyMask);
  EXPECT_EQ(hidden[89][1].status, Status::kOk) << "found again";
}

TEST(SeveralObjects, LabelWithoutAMask_StartsNothingButGoesOn) {
  host::Simulation simulation = Make(BoxBeforeBottle(20));
  const auto group = std::make_unique<Group>(
      Group::Objects{{{.config = {}, .mask_label = 1}, {.config = {}, .mask_label = 2}}});
  for (int i = 0; i < 20; ++i) {
    DepthFrame frame;
    simulation.Render(i, frame);
    if (i < 5 || i >= 10) frame.mask = {};
    Group::Estimates estimates;
    group->Process(frame, estimates);
    for (const Estimate& estimate : estimates)
      EXPECT_EQ(estimate.status, i < 5 ? Status::kEmptyMask : Status::kOk) << i;
  }
}

TEST(SeveralObjects, WithoutMasks_KeepToThemselves) {
  for (const host::NoiseKind noise : {host::NoiseKind::kClean, host::NoiseKind::kWhite}) {
    host::SimulationOptions options = BoxBeforeBottle(150);
    options.noise = noise;
    options.mask = host::MaskKind::kNone;
    host::Simulation simulation = Make(options);
    Group::Objects objects;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3d x = simulation.TruthAt(0, i).object.pose.translation();
      const PinholeCamera& camera = simulation.camera();
      SegmenterConfig& segmenter = objects[i].config.segmenter;
      segmenter.seed_u_px =
          static_cast<int>(camera.cx_px + camera.fx_px * static_cast<float>(x.x() / x.z()));
      segmenter.seed_v_px =
          static_cast<int>(camera.cy_px + camera.fy_px * static_cast<float>(x.y() / x.z()));
    }
    const auto group = std::make_unique<Group>(objects);
    std::array<Transform<Object, Object, double>, 2> T_true;
    std::array<int, 2> lost{};
    for (int i = 0; i < 150; ++i) {
      DepthFrame frame;
      simulation.Render(i, frame);
      Group::Estimates estimates;
      group->Process(frame, estimates);
      for (std::size_t k = 0; k < 2; ++k) {
        const auto truth = simulation.TruthAt(i, k).object.pose;
        if (i == 0) T_true[k] = PoseOf(estimates[k]).Inverse() * truth;
        if (estimates[k].status != Status::kOk) {
          ++lost[k];
          continue;
        }
        const auto claimed = PoseOf(estimates[k]) * T_true[k];
        EXPECT_LT((claimed.translation() - truth.translation()).norm(), 0.02)
            << "object " << k << ", frame " << i;
      }
    }
    for (std::size_t k = 0; k < 2; ++k) {
      FarthestSample farthest(T_true[k].translation());
      EXPECT_GT(StreamSamples((*group)[k].field(), farthest), 100);
      EXPECT_LT(farthest.distance_m(), BoundingRadius(simulation.mesh(k)) + 0.01) << "object " << k;
      EXPECT_LT(lost[k], 40) << "object " << k;
      EXPECT_EQ((*group)[k].totals().frames, 150U);
    }
  }
}

TEST(SeveralObjects, ThatHidesAnother_IsNotTakenForIt) {
  constexpr int kFrames = 110;
  host::SimulationOptions options = BoxBeforeBottle(kFrames);
  options.seed = 3;
  options.width_px = 320;
  options.height_px = 180;
  options.mask = host::MaskKind::kNone;
  host::Simulation simulation = Make(options);
  // The one behind is chosen; the box passes in front of it soon.
  Config config;
  const Vec3 place_m = simulation.TruthAt(0, 1).object.pose.translation().cast<float>();
  const Vec2 px = SimulatedCamera(options).Project(place_m);
  config.segmenter.seed_u_px = static_cast<int>(px.x());
  config.segmenter.seed_v_px = static_cast<int>(px.y());
  const auto tracker = std::make_unique<Tracker<profiles::Edge>>(config);
  bool was_hidden = false;
  Transform<Object, Object, double> T_true;
  Estimate estimate;
  for (int i = 0; i < kFrames; ++i) {
    DepthFrame frame;
    simulation.Render(i, frame);
    (void)tracker->Process(frame, estimate);
    was_hidden = was_hidden || estimate.state >= TrackingState::kDegraded;
    const auto truth = simulation.TruthAt(i, 1).object.pose;
    if (i == 0) T_true = PoseOf(estimate).Inverse() * truth;
    if (estimate.status != Status::kOk) continue;
    const auto claimed = PoseOf(estimate) * T_true;
    EXPECT_LT((claimed.translation() - truth.translation()).norm(), 0.02) << "frame " << i;
  }
  EXPECT_TRUE(was_hidden);
  EXPECT_EQ(estimate.reset_counter, 0);
}

}  // namespace
}  // namespace disflow
