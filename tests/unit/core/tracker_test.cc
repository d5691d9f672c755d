// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/tracker.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "changed_config.h"
#include "disflow/config_fields.h"
#include "disflow/surface_extractor.h"
#include "traced_scene.h"

namespace disflow::testing {
namespace {

using MicroTracker = Tracker<profiles::Micro>;
constexpr StampNs kFrame_ns = 33'333'333;
constexpr StampNs kStart_ns = 5'000'000'000;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A box that moves and turns steadily before a wall.
class MovingBox {
 public:
  [[nodiscard]] static PoseCameraFromObject TruthAt(StampNs stamp_ns) {
    const float t = Seconds(stamp_ns - kStart_ns);
    return {Mat3(ExpSo3(Vec3(t * kRate_rps)) * ExpSo3(Vec3(0.5F, 0.6F, 0.1F))),
            Vec3(Vec3(-0.03F, 0.0F, 0.42F) + t * kVelocity_mps)};
  }
  /// A frame whose pixels live until the next call.
  const DepthFrame& At(StampNs stamp_ns) {
    // Tests look at the same moments again and again.
    static std::map<StampNs, DepthScene> drawn;
    const auto [at, is_new] = drawn.try_emplace(stamp_ns, 1.2F);
    if (is_new) Trace(Box(Vec3(0.07F, 0.05F, 0.06F), 0.0F), TruthAt(stamp_ns), at->second);
    scene_ = at->second;
    return Finished(stamp_ns);
  }
  const DepthFrame& WithoutBox(StampNs stamp_ns) {
    scene_ = DepthScene(0.0F);
    return Finished(stamp_ns);
  }
  [[nodiscard]] DepthScene& scene() { return scene_; }

  static inline const Vec3 kVelocity_mps{0.15F, 0.05F, 0.1F};
  static inline const Vec3 kRate_rps{0.2F, 0.8F, -0.3F};

 private:
  const DepthFrame& Finished(StampNs stamp_ns) {
    frame_ = scene_.frame();
    frame_.stamp_ns = stamp_ns;
    return frame_;
  }

  DepthScene scene_;
  DepthFrame frame_;
};

/// Ways to spoil a frame so that it must be refused.
struct Spoiled {
  const char* what;
  Status status;
  std::function<void(DepthFrame&)> spoil;
};
const std::vector<Spoiled>& AllSpoiled() {
  static const std::array<std::uint8_t, 4> kFewPixels{};
  static const std::vector<Spoiled> all{
      {"no pixels", Status::kInvalidImageSize, [](DepthFrame& f) { f.depth.data = nullptr; }},
      {"no width", Status::kInvalidImageSize, [](DepthFrame& f) { f.depth.width_px = 0; }},
      {"short rows", Status::kInvalidImageSize, [](DepthFrame& f) { f.depth.stride_bytes = 7; }},
      {"too large", Status::kImageTooLarge, [](DepthFrame& f) { f.depth.width_px = 5000; }},
      {"no focal length", Status::kInvalidIntrinsics, [](DepthFrame& f) { f.camera.fx_px = kNan; }},
      {"tiny focal length", Status::kInvalidIntrinsics,
       [](DepthFrame& f) { f.camera.fx_px = f.camera.fy_px = 1e-30F; }},
      {"mask of another size", Status::kMaskSizeMismatch,
       [](DepthFrame& f) {
         f.mask = {kFewPixels.data(), 2, 2, 2};
       }},
      {"pose that is not finite", Status::kInvalidTransform,
       [](DepthFrame& f) {
         f.has_T_wc = true;
         f.T_wc = {Mat3(Mat3::Identity()), Vec3(kNan, 0.0F, 0.0F)};
       }},
      {"pose that is no motion", Status::kInvalidTransform,
       [](DepthFrame& f) {
         f.has_T_wc = true;
         f.T_wc = {Mat3(2.0F * Mat3::Identity()), Vec3(Vec3::Zero())};
       }},
  };
  return all;
}

/// A tracker on the moving box.
class Tracking {
 public:
  Estimate Process(StampNs stamp_ns) { return Give(box_.At(stamp_ns)); }
  Estimate Give(const DepthFrame& frame) {
    Estimate estimate;
    EXPECT_EQ(tracker_->Process(frame, estimate), estimate.status);
    return estimate;
  }
  Estimate Spoil(StampNs stamp_ns, const Spoiled& spoiled) {
    DepthFrame frame = box_.At(stamp_ns);
    spoiled.spoil(frame);
    return Give(frame);
  }
  /// Frames 0 to count - 1. @return The last one's estimate.
  Estimate Run(int count) {
    Estimate estimate;
    for (int i = 0; i < count; ++i) {
      estimate = Process(StampOf(i));
      EXPECT_EQ(estimate.status, Status::kOk) << i;
    }
    return estimate;
  }
  [[nodiscard]] static StampNs StampOf(int frame) { return kStart_ns + frame * kFrame_ns; }
  [[nodiscard]] MicroTracker& tracker() { return *tracker_; }
  [[nodiscard]] MovingBox& box() { return box_; }

 private:
  MovingBox box_;
  std::unique_ptr<MicroTracker> tracker_ = std::make_unique<MicroTracker>();
};

/// From where the object was taken to be in the first frame to where it is now.
PoseCameraFromObject SinceFirst(const PoseCameraFromObject& first,
                                const PoseCameraFromObject& now) {
  const Mat3 turn = now.rotation() * first.rotation().transpose();
  return {turn, Vec3(now.translation() - turn * first.translation())};
}
/// How far a tracked pose is from the truth, the object frame being that of the first estimate.
float OffBy(const Estimate& first, const Estimate& now, StampNs truth_ns) {
  const auto said = SinceFirst(first.T_co, now.T_co);
  const auto truth = SinceFirst(MovingBox::TruthAt(kStart_ns), MovingBox::TruthAt(truth_ns));
  return (said * first.T_co.translation() - truth * first.T_co.translation()).norm();
}

/// The estimate's bits that the tracker's state decides, all of them.
void ExpectSameEstimate(const Estimate& a, const Estimate& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.state, b.state);
  EXPECT_EQ(a.stamp_ns, b.stamp_ns);
  EXPECT_EQ(a.T_co.rotation(), b.T_co.rotation());
  EXPECT_EQ(a.T_co.translation(), b.T_co.translation());
  EXPECT_EQ(a.twist.linear_mps, b.twist.linear_mps);
  EXPECT_EQ(a.twist.angular_rps, b.twist.angular_rps);
  EXPECT_EQ(a.pose_covariance, b.pose_covariance);
  EXPECT_EQ(a.twist_covariance, b.twist_covariance);
  EXPECT_EQ(a.quality, b.quality);
  EXPECT_EQ(a.reset_counter, b.reset_counter);
  EXPECT_EQ(a.score, b.score);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.inliers, b.inliers);
  EXPECT_EQ(std::memcmp(&a.rejected, &b.rejected, sizeof a.rejected), 0);
}

/// All samples of a model.
class Collected final : public SampleSink {
 public:
  explicit Collected(const MicroTracker::Field& field) { (void)StreamSamples(field, *this); }
  std::vector<float> numbers;

 private:
  void DoOnSample(const SurfaceVertex& sample, int observations) noexcept override {
    for (int i = 0; i < 3; ++i) {
      numbers.push_back(sample.position_m(i));
      numbers.push_back(sample.normal(i));
    }
    numbers.push_back(sample.std_m);
    numbers.push_back(static_cast<float>(observations));
  }
};

TEST(Tracker, BoxInSteadyMotion_IsFollowed) {
  Tracking tracking;
  const Estimate first = tracking.Process(kStart_ns);
  Estimate last;
  for (int i = 1; i < 20; ++i) last = tracking.Process(Tracking::StampOf(i));
  EXPECT_EQ(last.status, Status::kOk);
  EXPECT_EQ(last.state, TrackingState::kTracking);
  EXPECT_LT(OffBy(first, last, last.stamp_ns), 0.003F);
}

TEST(Tracker, RefusedFrame_ChangesNothingButTheCounters) {
  for (const Spoiled& spoiled : AllSpoiled()) {
    SCOPED_TRACE(spoiled.what);
    Tracking undisturbed;
    Tracking disturbed;
    (void)undisturbed.Run(6);
    (void)disturbed.Run(6);
    const Counters before = disturbed.tracker().totals();
    const std::vector<float> model = Collected(disturbed.tracker().field()).numbers;
    const Estimate refused = disturbed.Spoil(Tracking::StampOf(6) - kFrame_ns / 2, spoiled);
    EXPECT_EQ(refused.status, spoiled.status);
    EXPECT_EQ(Collected(disturbed.tracker().field()).numbers, model);
    Counters expected = before;
    ++expected.frames;
    ++expected.frames_rejected;
    EXPECT_EQ(std::memcmp(&disturbed.tracker().totals(), &expected, sizeof expected), 0);
    // As if it had not been.
    for (int i = 6; i < 9; ++i) {
      ExpectSameEstimate(disturbed.Process(Tracking::StampOf(i)),
                         undisturbed.Process(Tracking::StampOf(i)));
    }
  }
}

TEST(Tracker, RefusedFramesOfAnyStamp_DoNotMoveTheClock) {
  Tracking undisturbed;
  Tracking disturbed;
  (void)undisturbed.Run(6);
  (void)disturbed.Run(6);
  for (const StampNs stamp_ns :
       {std::numeric_limits<StampNs>::max(), std::numeric_limits<StampNs>::min(), StampNs{0},
        Tracking::StampOf(5), Tracking::StampOf(100)}) {
    DepthFrame frame = disturbed.box().At(Tracking::StampOf(6));
    frame.stamp_ns = stamp_ns;
    frame.depth.data = nullptr;
    const Estimate estimate = disturbed.Give(frame);
    EXPECT_NE(estimate.status, Status::kOk);
    EXPECT_TRUE(estimate.T_co.IsFinite());
    EXPECT_TRUE(estimate.pose_covariance.allFinite());
  }
  ExpectSameEstimate(disturbed.Process(Tracking::StampOf(6)),
                     undisturbed.Process(Tracking::StampOf(6)));
}

TEST(Tracker, RefusedFrame_SaysWhereTheObjectIsByThen) {
  for (const Spoiled& spoiled : AllSpoiled()) {
    SCOPED_TRACE(spoiled.what);
    Tracking tracking;
    const Estimate first = tracking.Process(kStart_ns);
    Estimate last;
    for (int i = 1; i < 12; ++i) last = tracking.Process(Tracking::StampOf(i));
    const StampNs later_ns = Tracking::StampOf(14);
    const Estimate refused = tracking.Spoil(later_ns, spoiled);
    EXPECT_EQ(refused.stamp_ns, later_ns);
    EXPECT_LT(OffBy(first, refused, later_ns), 0.004F);
    EXPECT_GT(OffBy(first, last, later_ns), 0.012F) << "the old pose would not do";
    EXPECT_FALSE(refused.has_T_wo && !refused.T_wo.IsFinite());
  }
}

TEST(Tracker, RefusedFrames_CovarianceGrowsUntilAPoseIsRegistered) {
  Tracking tracking;
  const Estimate last = tracking.Run(12);
  Vec6 pose = last.pose_covariance.diagonal();
  Vec6 twist = last.twist_covariance.diagonal();
  const Spoiled& spoiled = AllSpoiled().front();
  for (int i = 12; i < 40; ++i) {
    SCOPED_TRACE(i);
    const Estimate refused = tracking.Spoil(Tracking::StampOf(i), spoiled);
    EXPECT_TRUE((refused.pose_covariance.diagonal().array() > pose.array()).all());
    EXPECT_TRUE((refused.twist_covariance.diagonal().array() >= twist.array()).all());
    pose = refused.pose_covariance.diagonal();
    twist = refused.twist_covariance.diagonal();
  }
  // The velocity was known to some centimetres per second, for a second.
  EXPECT_GT(std::sqrt(pose(0)), 0.02F);
  const Estimate found = tracking.Process(Tracking::StampOf(13));
  EXPECT_EQ(found.status, Status::kOk);
  EXPECT_LT(found.pose_covariance(0, 0), pose(0));
}

TEST(Tracker, RefusedAfterUnregisteredFrames_CovarianceGoesOnGrowing) {
  Tracking tracking;
  (void)tracking.Run(12);
  const Estimate unseen = tracking.Give(tracking.box().WithoutBox(Tracking::StampOf(12)));
  EXPECT_EQ(unseen.status, Status::kNoValidDepth);
  const Estimate refused = tracking.Spoil(Tracking::StampOf(13), AllSpoiled().front());
  EXPECT_GT((refused.pose_covariance - unseen.pose_covariance).diagonal().minCoeff(), 0.0F);
}

TEST(Tracker, StampThatDoesNotIncrease_IsAnsweredForTheLastFrameTaken) {
  Tracking tracking;
  const Estimate last = tracking.Run(8);
  (void)tracking.Spoil(Tracking::StampOf(20), AllSpoiled().front());
  for (const StampNs stamp_ns :
       {last.stamp_ns, last.stamp_ns - 1, StampNs{-1}, std::numeric_limits<StampNs>::min()}) {
    DepthFrame frame = tracking.box().At(Tracking::StampOf(8));
    frame.stamp_ns = stamp_ns;
    frame.has_T_wc = true;
    const Estimate refused = tracking.Give(frame);
    EXPECT_EQ(refused.status, Status::kStampNotIncreasing);
    EXPECT_EQ(refused.stamp_ns, last.stamp_ns);
    EXPECT_EQ(refused.T_co.translation(), last.T_co.translation());
    EXPECT_EQ(refused.T_co.rotation(), last.T_co.rotation());
    EXPECT_GE((refused.pose_covariance - last.pose_covariance).diagonal().minCoeff(), 0.0F);
    EXPECT_FALSE(refused.has_T_wo) << "that camera pose is of another moment";
  }
}

TEST(Tracker, RefusedBeforeTheFirstFrame_NothingIsClaimed) {
  for (const Spoiled& spoiled : AllSpoiled()) {
    SCOPED_TRACE(spoiled.what);
    Tracking tracking;
    const Estimate refused = tracking.Spoil(kStart_ns - 1, spoiled);
    EXPECT_EQ(refused.status, spoiled.status);
    EXPECT_EQ(refused.quality, 0);
    EXPECT_EQ(refused.state, TrackingState::kInitialising);
    EXPECT_EQ(refused.stamp_ns, kStart_ns - 1);
    EXPECT_FALSE(refused.has_T_wo);
    Tracking undisturbed;
    Estimate a = tracking.Process(kStart_ns);
    ExpectSameEstimate(a, undisturbed.Process(kStart_ns));
  }
}

/// Two things before a wall, the left one nearer. No two images are the same to the bit.
const DepthFrame& TwoThings(StampNs stamp_ns) {
  static DepthScene scene;
  static DepthFrame frame;
  const float wall_m = 1.5F + 1e-4F * Seconds(stamp_ns - kStart_ns);
  scene = DepthScene(wall_m).Rectangle({20, 30, 60, 90}, 0.5F).Rectangle({95, 30, 140, 90}, 0.7F);
  frame = scene.frame();
  frame.stamp_ns = stamp_ns;
  return frame;
}

TEST(TrackerChoose, OtherThing_IsTrackedFromTheNextFrameOn) {
  const auto tracker = std::make_unique<MicroTracker>();
  Estimate estimate;
  ASSERT_EQ(tracker->Process(TwoThings(Tracking::StampOf(0)), estimate), Status::kOk);
  EXPECT_NEAR(estimate.T_co.translation().z(), 0.5F, 0.01F);
  ObjectStart start;
  start.seed_u_px = 110;
  start.seed_v_px = 60;
  ASSERT_EQ(tracker->Choose(start), Status::kOk);
  EXPECT_TRUE(tracker->field().empty());
  ASSERT_EQ(tracker->Process(TwoThings(Tracking::StampOf(1)), estimate), Status::kOk);
  EXPECT_NEAR(estimate.T_co.translation().z(), 0.7F, 0.01F);
  EXPECT_EQ(estimate.reset_counter, 1);
  // A start after it takes what was chosen too.
  tracker->Reset();
  ASSERT_EQ(tracker->Process(TwoThings(Tracking::StampOf(2)), estimate), Status::kOk);
  EXPECT_NEAR(estimate.T_co.translation().z(), 0.7F, 0.01F);
  // A box around the left one.
  start = {};
  start.roi_x_px = 10;
  start.roi_y_px = 20;
  start.roi_width_px = 60;
  start.roi_height_px = 90;
  ASSERT_EQ(tracker->Choose(start), Status::kOk);
  ASSERT_EQ(tracker->Process(TwoThings(Tracking::StampOf(3)), estimate), Status::kOk);
  EXPECT_NEAR(estimate.T_co.translation().z(), 0.5F, 0.01F);
}

TEST(TrackerChoose, PlaceOutOfRange_IsRefusedAndChangesNothing) {
  const auto tracker = std::make_unique<MicroTracker>();
  Estimate estimate;
  ASSERT_EQ(tracker->Process(TwoThings(Tracking::StampOf(0)), estimate), Status::kOk);
  for (const int wrong : {-2, 8192, std::numeric_limits<int>::max()}) {
    ObjectStart start;
    start.seed_u_px = start.seed_v_px = wrong;
    EXPECT_EQ(tracker->Choose(start), Status::kInvalidConfig);
  }
  EXPECT_FALSE(tracker->field().empty());
  ASSERT_EQ(tracker->Process(TwoThings(Tracking::StampOf(1)), estimate), Status::kOk);
  EXPECT_EQ(estimate.reset_counter, 0);
}

/// The widest partners, so that any setting may be moved to an end of its range.
Config WideConfig() {
  Config config;
  config.segmenter.min_range_m = 0.0F;
  config.sampler.min_block_px = 1;
  config.sampler.max_block_px = 64;
  return config;
}

TEST(TrackerAdjust, SettingsThatAreMarked_AreThoseThatChange) {
  const auto tracker = std::make_unique<MicroTracker>(WideConfig());
  const auto is_same = [](const Config& a, const Config& b) {
    return std::memcmp(&a, &b, sizeof(Config)) == 0;
  };
  for (int i = 0; i < FieldCount(); ++i) {
    Config wanted = WideConfig();
    const std::string name = ChangeField(wanted, i, kMaximum);
    if (is_same(wanted, WideConfig())) ChangeField(wanted, i, kMinimum);
    if (Validate(wanted).field != nullptr) continue;  // does not go with the others
    ASSERT_EQ(tracker->Adjust(wanted), Status::kOk) << name;
    VisitFields(tracker->config(), [&](const auto& field) {
      if (name != field.name) return;
      EXPECT_EQ(is_same(tracker->config(), wanted), field.at_run_time) << name;
    });
    ASSERT_EQ(tracker->Adjust(WideConfig()), Status::kOk);
  }
}

TEST(TrackerAdjust, ObjectAndItsModel_AreKept) {
  const auto tracker = std::make_unique<MicroTracker>();
  Estimate estimate;
  ASSERT_EQ(tracker->Process(TwoThings(Tracking::StampOf(0)), estimate), Status::kOk);
  Config wanted = tracker->config();
  // The farther thing, which the object that is tracked is not.
  wanted.segmenter.seed_u_px = 110;
  wanted.segmenter.seed_v_px = 60;
  wanted.monitor.degraded_score = 1.0F;
  wanted.field.cell_size_m = 0.05F;
  ASSERT_EQ(tracker->Adjust(wanted), Status::kOk);
  EXPECT_FALSE(tracker->field().empty());
  for (int i = 1; i < 8; ++i)
    ASSERT_EQ(tracker->Process(TwoThings(Tracking::StampOf(i)), estimate), Status::kOk);
  EXPECT_NEAR(estimate.T_co.translation().z(), 0.5F, 0.01F);
  EXPECT_EQ(estimate.reset_counter, 0);
  EXPECT_EQ(tracker->config().monitor.degraded_score, 1.0F);
}

TEST(TrackerAdjust, MonitorAndTwistFilter_TakeTheirSettingsAtTheNextFrame) {
  const auto tracker = std::make_unique<MicroTracker>();
  Estimate estimate;
  int frame = 0;
  for (; frame < 10; ++frame)
    ASSERT_EQ(tracker->Process(TwoThings(Tracking::StampOf(frame)), estimate), Status::kOk);
  ASSERT_EQ(estimate.state, TrackingState::kTracking);
  const float std_before = estimate.twist_covariance(0, 0);
  Config wanted;
  wanted.monitor.degraded_std_m = 0.0F;
  wanted.twist.linear_jerk_psd = 1e6F;
  ASSERT_EQ(tracker->Adjust(wanted), Status::kOk);
  ASSERT_EQ(tracker->Process(TwoThings(Tracking::StampOf(frame)), estimate), Status::kOk);
  EXPECT_EQ(estimate.state, TrackingState::kDegraded);
  EXPECT_GT(estimate.twist_covariance(0, 0), 2.0F * std_before);
}

TEST(TrackerAdjust, SettingsThatDoNotGoTogether_AreRefusedAndChangeNothing) {
  const auto tracker = std::make_unique<MicroTracker>();
  Config wanted;
  wanted.registration.iterations = 20;
  wanted.segmenter.min_range_m = wanted.segmenter.max_range_m;
  EXPECT_EQ(tracker->Adjust(wanted), Status::kInvalidConfig);
  EXPECT_EQ(tracker->config().registration.iterations, Config{}.registration.iterations);
  EXPECT_EQ(tracker->config_issue().field, nullptr);
}

TEST(TrackerChoose, NothingAtThePlace_StartsNothingUntilThereIs) {
  const auto tracker = std::make_unique<MicroTracker>();
  Estimate estimate;
  ObjectStart start;
  start.seed_u_px = 75;
  start.seed_v_px = 10;
  ASSERT_EQ(tracker->Choose(start), Status::kOk);
  EXPECT_EQ(tracker->Process(TwoThings(Tracking::StampOf(0)), estimate), Status::kNoValidDepth);
  EXPECT_TRUE(tracker->field().empty());
}

TEST(Tracker, InvalidConfig_RefusesEveryFrame) {
  Config config;
  config.field.cell_size_m = -1.0F;
  const auto tracker = std::make_unique<MicroTracker>(config);
  MovingBox box;
  Estimate estimate;
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(tracker->Process(box.At(Tracking::StampOf(i)), estimate), Status::kInvalidConfig);
  EXPECT_EQ(tracker->totals().frames_rejected, 3U);
  EXPECT_TRUE(tracker->field().empty());
}

/// The image of one frame under the stamp of another.
DepthFrame Repeated(Tracking& tracking, int image, int frame) {
  DepthFrame repeated = tracking.box().At(Tracking::StampOf(image));
  repeated.stamp_ns = Tracking::StampOf(frame);
  return repeated;
}

TEST(Tracker, RepeatedImages_ArePredictedAndDoNotDisturbTheVelocity) {
  Tracking tracking;
  const Estimate first = tracking.Process(kStart_ns);
  for (int i = 1; i < 15; ++i) (void)tracking.Process(Tracking::StampOf(i));
  for (int i = 15; i < 39; i += 3) {
    SCOPED_TRACE(i);
    const Estimate seen = tracking.Process(Tracking::StampOf(i));
    EXPECT_EQ(seen.status, Status::kOk);
    EXPECT_EQ(seen.rejected.images_repeated, 0U);
    Estimate before = seen;
    for (const int repeat : {i + 1, i + 2}) {
      const Estimate predicted = tracking.Give(Repeated(tracking, i, repeat));
      EXPECT_EQ(predicted.status, Status::kRepeatedImage);
      EXPECT_EQ(KindOf(predicted), EstimateKind::kPredicted);
      EXPECT_EQ(predicted.rejected.images_repeated, 1U);
      EXPECT_EQ(predicted.state, seen.state);
      EXPECT_EQ(predicted.quality, seen.quality);
      EXPECT_LT(OffBy(first, predicted, predicted.stamp_ns), 0.004F);
      EXPECT_EQ(predicted.twist.linear_mps, seen.twist.linear_mps);
      EXPECT_GT((predicted.pose_covariance - before.pose_covariance).diagonal().minCoeff(), 0.0F);
      before = predicted;
    }
  }
  EXPECT_EQ(tracking.tracker().totals().images_repeated, 16U);
}

TEST(Tracker, CameraThatHangs_LosesTheMovingObject) {
  Tracking tracking;
  (void)tracking.Run(15);
  Estimate estimate;
  for (int i = 15; i < 35; ++i) {
    estimate = tracking.Give(Repeated(tracking, 14, i));
    EXPECT_EQ(estimate.status, Status::kRepeatedImage) << i;
  }
  EXPECT_EQ(estimate.state, TrackingState::kLost);
}

TEST(Tracker, SameImageOfAnObjectAtRest_HoldsAfterAMoment) {
  Tracking tracking;
  Estimate estimate;
  int measured = 0;
  for (int i = 0; i < 40; ++i) {
    estimate = tracking.Give(Repeated(tracking, 0, i));
    if (estimate.status == Status::kOk) ++measured;
    EXPECT_NE(estimate.state, TrackingState::kDegraded) << i;
    EXPECT_NE(estimate.state, TrackingState::kLost) << i;
  }
  EXPECT_EQ(estimate.state, TrackingState::kTracking);
  EXPECT_GE(measured, 36);
  EXPECT_EQ(tracking.tracker().totals().images_repeated, 39U);
}

TEST(Tracker, ImageThatDiffersInOneBitOfTheRowsLookedAt_IsNoRepeat) {
  Tracking tracking;
  (void)tracking.Run(10);
  DepthFrame frame = tracking.box().At(Tracking::StampOf(9));
  const auto row_bytes = static_cast<std::size_t>(frame.depth.stride_bytes);
  std::vector<std::byte> pixels(row_bytes * static_cast<std::size_t>(frame.depth.height_px));
  std::memcpy(pixels.data(), frame.depth.data, pixels.size());
  frame.depth.data = pixels.data();
  for (const std::size_t byte : {std::size_t{0}, row_bytes - 4, 4 * row_bytes + 8}) {
    pixels[byte] ^= std::byte{1};
    frame.stamp_ns += kFrame_ns;
    EXPECT_EQ(tracking.Give(frame).rejected.images_repeated, 0U);
  }
  frame.stamp_ns += kFrame_ns;
  EXPECT_EQ(tracking.Give(frame).rejected.images_repeated, 1U);
}

TEST(Tracker, FirstAndLastOfAllStamps_AreTaken) {
  Tracking tracking;
  constexpr StampNs kMin = std::numeric_limits<StampNs>::min();
  constexpr StampNs kMax = std::numeric_limits<StampNs>::max();
  DepthFrame frame = tracking.box().At(kStart_ns);
  for (const StampNs stamp_ns : {kMin, kMin + 1, kMin + kFrame_ns, StampNs{-1}, StampNs{0},
                                 kStart_ns, kMax - kFrame_ns, kMax - 1, kMax}) {
    frame.stamp_ns = stamp_ns;
    const Estimate estimate = tracking.Give(frame);
    // After such gaps the pose may be called lost, but the frame is a frame.
    EXPECT_EQ(estimate.rejected.frames_rejected, 0U) << stamp_ns;
    EXPECT_EQ(estimate.stamp_ns, stamp_ns);
    EXPECT_TRUE(estimate.T_co.IsFinite());
    EXPECT_TRUE(estimate.pose_covariance.allFinite());
    EXPECT_TRUE(estimate.twist_covariance.allFinite());
  }
  frame.depth.data = nullptr;
  frame.stamp_ns = kMax;
  EXPECT_EQ(tracking.Give(frame).status, Status::kStampNotIncreasing);
}

bool IsFinite(const Estimate& estimate) {
  return estimate.T_co.IsFinite() && estimate.twist.linear_mps.allFinite() &&
         estimate.twist.angular_rps.allFinite() && estimate.pose_covariance.allFinite() &&
         estimate.twist_covariance.allFinite() && estimate.weak.axis.allFinite() &&
         std::isfinite(estimate.weak.std) && std::isfinite(estimate.score) &&
         std::isfinite(estimate.conflict) && std::isfinite(estimate.visible) &&
         std::isfinite(estimate.rms_m) && std::isfinite(estimate.inverse_depth_std_per_m);
}

TEST(Tracker, AnyIntrinsics_AreRefusedOrGiveFiniteEstimates) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-38.0F, 38.0F);
  std::uniform_real_distribution<float> usual(-2.0F, 7.0F);
  std::uniform_int_distribution<int> coin(0, 1);
  int taken = 0;
  for (int i = 0; i < 200; ++i) {
    const auto draw = [&](std::uniform_real_distribution<float>& decade) {
      return std::pow(10.0F, decade(random));
    };
    auto& decade = i % 4 == 0 ? exponent : usual;
    const auto center = [&](float middle_px) {
      return coin(random) == 0 ? middle_px : (coin(random) == 0 ? -1.0F : 1.0F) * draw(decade);
    };
    PinholeCamera camera{draw(decade), draw(decade), center(80.0F), center(60.0F)};
    if (coin(random) == 0) camera.fy_px = camera.fx_px;
    Tracking tracking;
    for (int k = 0; k < 3; ++k) {
      DepthFrame frame = tracking.box().At(Tracking::StampOf(k));
      frame.camera = camera;
      const Estimate estimate = tracking.Give(frame);
      taken += estimate.status == Status::kOk ? 1 : 0;
      ASSERT_TRUE(IsFinite(estimate))
          << camera.fx_px << " " << camera.fy_px << " " << camera.cx_px << " " << camera.cy_px;
      for (const float number : Collected(tracking.tracker().field()).numbers)
        ASSERT_TRUE(std::isfinite(number));
    }
  }
  EXPECT_GT(taken, 15);
}

// What outlines are taken to be off by decides how sure a pose is, not where it is.
TEST(Tracker, OutlinesThatAreOffAlikeByMore_LeaveThePoseItselfAndMakeItLessSure) {
  Config config;
  config.registration.drift_outline *= 40.0F;
  Tracking usual;
  Tracking vague;
  ASSERT_EQ(vague.tracker().Adjust(config), Status::kOk);
  const Estimate a = usual.Run(15);
  const Estimate b = vague.Run(15);
  EXPECT_EQ(a.T_co.translation(), b.T_co.translation());
  EXPECT_EQ(a.T_co.rotation(), b.T_co.rotation());
  for (int i = 0; i < 3; ++i) EXPECT_GT(b.pose_covariance(i, i), a.pose_covariance(i, i)) << i;
}

TEST(Tracker, ImageUpsideDown_TurnsPoseTwistAndCovariance) {
  const Mat3 turn = Vec3(-1.0F, -1.0F, 1.0F).asDiagonal();
  Mat6 both = Mat6::Zero();
  both.topLeftCorner<3, 3>() = turn;
  both.bottomRightCorner<3, 3>() = turn;
  Tracking upright;
  Tracking upside_down;
  Estimate a;
  Estimate b;
  for (int i = 0; i < 15; ++i) {
    a = upright.Process(Tracking::StampOf(i));
    DepthFrame frame = upside_down.box().At(Tracking::StampOf(i));
    DepthScene turned;
    const DepthScene& scene = upside_down.box().scene();
    turned.Draw(DepthScene::image(), [&scene](int u, int v) {
      return scene.At(DepthScene::kWidth_px - 1 - u, DepthScene::kHeight_px - 1 - v);
    });
    frame.depth = turned.frame().depth;
    frame.camera.cx_px = DepthScene::kWidth_px - 1 - frame.camera.cx_px;
    frame.camera.cy_px = DepthScene::kHeight_px - 1 - frame.camera.cy_px;
    b = upside_down.Give(frame);
  }
  ASSERT_EQ(a.status, Status::kOk);
  ASSERT_EQ(b.status, Status::kOk);
  // Pixel blocks start at the object's other corner, so the samples are others.
  EXPECT_LT((turn * a.T_co.translation() - b.T_co.translation()).norm(), 0.003F);
  EXPECT_LT((turn * a.twist.linear_mps - b.twist.linear_mps).norm(), 0.03F);
  const Mat6 pose = both * a.pose_covariance * both.transpose();
  const Mat6 twist = both * a.twist_covariance * both.transpose();
  EXPECT_LT((pose - b.pose_covariance).norm(), 0.5F * pose.norm());
  EXPECT_LT((twist - b.twist_covariance).norm(), 0.3F * twist.norm());
  for (int i = 0; i < 6; ++i) {
    EXPECT_LT(pose(i, i), 2.0F * b.pose_covariance(i, i)) << i;
    EXPECT_GT(pose(i, i), 0.5F * b.pose_covariance(i, i)) << i;
  }
}

/// A turntable that is photographed once a second.
class Turntable {
 public:
  static constexpr StampNs kStep_ns = 1'000'000'000;
  Estimate Fuse(int i, const PoseObjectFromCamera& T_oc, const DepthFrame& frame) {
    DepthFrame at = frame;
    at.stamp_ns = kStart_ns + i * kStep_ns;
    Estimate estimate;
    EXPECT_EQ(tracker_->Fuse(at, T_oc, estimate), estimate.status);
    return estimate;
  }
  Estimate Fuse(int i) {
    // Slower than the stamps say: the box stays in view.
    const StampNs place_ns = kStart_ns + i * kFrame_ns;
    return Fuse(i, MovingBox::TruthAt(place_ns).Inverse(), box_.At(place_ns));
  }
  [[nodiscard]] MovingBox& box() { return box_; }
  [[nodiscard]] MicroTracker& tracker() { return *tracker_; }

 private:
  MovingBox box_;
  std::unique_ptr<MicroTracker> tracker_ = std::make_unique<MicroTracker>();
};

TEST(TrackerFuse, KnownPoses_AreTrackedHoweverSeldomTheyCome) {
  Turntable turntable;
  for (int i = 0; i < 12; ++i) {
    const Estimate estimate = turntable.Fuse(i);
    EXPECT_EQ(estimate.status, Status::kOk);
    EXPECT_LT(
        (estimate.T_co.translation() - MovingBox::TruthAt(kStart_ns + i * kFrame_ns).translation())
            .norm(),
        1e-5F);
    if (i < 6) continue;
    EXPECT_EQ(estimate.state, TrackingState::kTracking);
    EXPECT_GT(estimate.quality, 80);
  }
}

TEST(TrackerFuse, ThingsBesideTheObject_AreNotTakenForIt) {
  Turntable turntable;
  for (int i = 0; i < 6; ++i) (void)turntable.Fuse(i);
  // As near as an object that was lost may be.
  const StampNs place_ns = kStart_ns + 6 * kFrame_ns;
  const PoseCameraFromObject T_co = MovingBox::TruthAt(place_ns);
  DepthFrame frame = turntable.box().At(place_ns);
  const PinholeCamera camera = frame.camera;
  const Vec2 center_px = camera.Project(T_co.translation());
  const auto right_px =
      static_cast<int>(center_px.x() + 0.125F / T_co.translation().z() * camera.fx_px);
  const PixelBox beside{right_px, 40, right_px + 12, 80};
  turntable.box().scene().Rectangle(beside, T_co.translation().z());
  const Estimate estimate = turntable.Fuse(6, T_co.Inverse(), frame);
  EXPECT_EQ(estimate.status, Status::kOk);
  int foreign = 0;
  for (int v = beside.v_min; v < beside.v_max; ++v) {
    for (int u = beside.u_min; u < beside.u_max; ++u)
      foreign += turntable.tracker().last_mask().Test(u, v) ? 1 : 0;
  }
  EXPECT_EQ(foreign, 0);
}

TEST(TrackerFuse, PoseThatIsNotFinite_IsRefusedAndCountedAsSuch) {
  Turntable turntable;
  for (int i = 0; i < 3; ++i) (void)turntable.Fuse(i);
  const Estimate refused = turntable.Fuse(3, {Mat3(Mat3::Identity()), Vec3(0.0F, kNan, 0.0F)},
                                          turntable.box().At(kStart_ns + 3 * kFrame_ns));
  EXPECT_EQ(refused.status, Status::kInvalidTransform);
  EXPECT_EQ(refused.rejected.frames_rejected, 1U);
  EXPECT_EQ(refused.rejected.frames_unregistered, 0U);
  EXPECT_TRUE(IsFinite(refused));
  EXPECT_EQ(turntable.Fuse(4).status, Status::kOk);
  EXPECT_EQ(turntable.tracker().totals().frames_rejected, 1U);
}

TEST(TrackerFuse, ObjectOutOfSight_KeepsItsModelAndItsKnownPose) {
  Turntable turntable;
  for (int i = 0; i < 3; ++i) (void)turntable.Fuse(i);
  const int clusters = turntable.tracker().field().store().size();
  for (int i = 3; i < 12; ++i) {
    const PoseCameraFromObject T_co = MovingBox::TruthAt(kStart_ns + i * kFrame_ns);
    const Estimate unseen =
        turntable.Fuse(i, T_co.Inverse(), turntable.box().WithoutBox(kStart_ns));
    EXPECT_EQ(unseen.status, Status::kNoValidDepth);
    EXPECT_LT((unseen.T_co.translation() - T_co.translation()).norm(), 1e-5F);
    EXPECT_EQ(unseen.reset_counter, 0);
  }
  EXPECT_EQ(turntable.tracker().field().store().size(), clusters);
  EXPECT_EQ(turntable.Fuse(12).status, Status::kOk);
}

}  // namespace
}  // namespace disflow::testing
