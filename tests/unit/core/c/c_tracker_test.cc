// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

#include "disflow/tracker.h"
#include "tracked_box.h"

namespace disflow::testing {
namespace {

// The numbers are the same, so that they can be looked up in one list.
static_assert(DISFLOW_OK == static_cast<int>(Status::kOk));
static_assert(DISFLOW_INVALID_CONFIG == static_cast<int>(Status::kInvalidConfig));
static_assert(DISFLOW_INVALID_INTRINSICS == static_cast<int>(Status::kInvalidIntrinsics));
static_assert(DISFLOW_INVALID_IMAGE_SIZE == static_cast<int>(Status::kInvalidImageSize));
static_assert(DISFLOW_IMAGE_TOO_LARGE == static_cast<int>(Status::kImageTooLarge));
static_assert(DISFLOW_MASK_SIZE_MISMATCH == static_cast<int>(Status::kMaskSizeMismatch));
static_assert(DISFLOW_EMPTY_MASK == static_cast<int>(Status::kEmptyMask));
static_assert(DISFLOW_NO_VALID_DEPTH == static_cast<int>(Status::kNoValidDepth));
static_assert(DISFLOW_TOO_FEW_SAMPLES == static_cast<int>(Status::kTooFewSamples));
static_assert(DISFLOW_STAMP_NOT_INCREASING == static_cast<int>(Status::kStampNotIncreasing));
static_assert(DISFLOW_INVALID_TRANSFORM == static_cast<int>(Status::kInvalidTransform));
static_assert(DISFLOW_NOT_INITIALISED == static_cast<int>(Status::kNotInitialised));
static_assert(DISFLOW_REGISTRATION_FAILED == static_cast<int>(Status::kRegistrationFailed));
static_assert(DISFLOW_OUT_OF_BOUNDS == static_cast<int>(Status::kOutOfBounds));
static_assert(DISFLOW_CAPACITY_EXCEEDED == static_cast<int>(Status::kCapacityExceeded));
static_assert(DISFLOW_REPEATED_IMAGE == static_cast<int>(Status::kRepeatedImage));
static_assert(DISFLOW_NOT_FOUND == static_cast<int>(Status::kNotFound));
static_assert(DISFLOW_RECOVERED == static_cast<int>(TrackingState::kRecovered));
static_assert(DISFLOW_REFUSED == static_cast<int>(EstimateKind::kRefused));
static_assert(DISFLOW_WEAK_ROTATION == static_cast<int>(WeakKind::kRotation));

template <int kSize>
void ExpectSame(const float (&c)[kSize], const float* cpp, const char* what) {
  for (int i = 0; i < kSize; ++i) EXPECT_EQ(c[i], cpp[i]) << what << " " << i;
}

void ExpectSame(const disflow_counters& c, const Counters& cpp) {
  EXPECT_EQ(c.frames, cpp.frames);
  EXPECT_EQ(c.frames_rejected, cpp.frames_rejected);
  EXPECT_EQ(c.frames_unregistered, cpp.frames_unregistered);
  EXPECT_EQ(c.images_repeated, cpp.images_repeated);
  EXPECT_EQ(c.pixels_out_of_range, cpp.pixels_out_of_range);
  EXPECT_EQ(c.runs_dropped, cpp.runs_dropped);
  EXPECT_EQ(c.blocks_sparse, cpp.blocks_sparse);
  EXPECT_EQ(c.blocks_grazing, cpp.blocks_grazing);
  EXPECT_EQ(c.blocks_flying, cpp.blocks_flying);
  EXPECT_EQ(c.samples_dropped, cpp.samples_dropped);
  EXPECT_EQ(c.residuals_unmatched, cpp.residuals_unmatched);
  EXPECT_EQ(c.residuals_truncated, cpp.residuals_truncated);
  EXPECT_EQ(c.residuals_normal_mismatch, cpp.residuals_normal_mismatch);
  EXPECT_EQ(c.observations_rejected, cpp.observations_rejected);
  EXPECT_EQ(c.observations_out_of_bounds, cpp.observations_out_of_bounds);
  EXPECT_EQ(c.samples_refused, cpp.samples_refused);
  EXPECT_EQ(c.clusters_evicted, cpp.clusters_evicted);
  EXPECT_EQ(c.clusters_forgotten, cpp.clusters_forgotten);
  EXPECT_EQ(c.edges_refused, cpp.edges_refused);
  EXPECT_EQ(c.candidates_dropped, cpp.candidates_dropped);
}

void ExpectSame(const disflow_estimate& c, const Estimate& cpp) {
  EXPECT_EQ(c.stamp_ns, cpp.stamp_ns);
  EXPECT_EQ(c.status, static_cast<int>(cpp.status));
  EXPECT_EQ(c.state, static_cast<int>(cpp.state));
  EXPECT_EQ(c.kind, static_cast<int>(KindOf(cpp)));
  ExpectSame(c.T_co.position_m, cpp.T_co.translation().data(), "position");
  const auto rotation = cpp.T_co.rotation_quaternion();
  ExpectSame(c.T_co.quaternion_xyzw, rotation.coeffs().data(), "rotation");
  ExpectSame(c.linear_mps, cpp.twist.linear_mps.data(), "v");
  ExpectSame(c.angular_rps, cpp.twist.angular_rps.data(), "omega");
  ExpectSame(c.pose_covariance, Mat6(cpp.pose_covariance.transpose()).data(), "pose covariance");
  ExpectSame(c.twist_covariance, Mat6(cpp.twist_covariance.transpose()).data(), "twist covariance");
  EXPECT_EQ(c.weak_kind, static_cast<int>(cpp.weak.kind));
  ExpectSame(c.weak_axis, cpp.weak.axis.data(), "weak axis");
  EXPECT_EQ(c.weak_std, cpp.weak.std);
  EXPECT_EQ(c.quality, cpp.quality);
  EXPECT_EQ(c.reset_counter, cpp.reset_counter);
  EXPECT_EQ(c.score, cpp.score);
  EXPECT_EQ(c.conflict, cpp.conflict);
  EXPECT_EQ(c.visible, cpp.visible);
  EXPECT_EQ(c.samples, cpp.samples);
  EXPECT_EQ(c.inliers, cpp.inliers);
  EXPECT_EQ(c.edge_inliers, cpp.edge_inliers);
  EXPECT_EQ(c.hypotheses, cpp.hypotheses);
  EXPECT_EQ(c.iterations, cpp.iterations);
  EXPECT_EQ(c.rms_m, cpp.rms_m);
  EXPECT_EQ(c.inverse_depth_std_per_m, cpp.inverse_depth_std_per_m);
  ExpectSame(c.rejected, cpp.rejected);
}

TEST(CTracker, EveryFrame_YieldsWhatTheCppTrackerYields) {
  constexpr int kFrames = 12;
  const auto tracker = std::make_unique<Tracker<profiles::Micro>>();
  TrackerInC in_c;
  ASSERT_NE(in_c.get(), nullptr);
  for (int i = 0; i < kFrames; ++i) {
    const DepthScene scene = BoxAt(static_cast<float>(i) / 30.0F);
    DepthFrame frame = scene.frame();
    frame.stamp_ns = StampOf(i);
    Estimate expected;
    (void)tracker->Process(frame, expected);
    const disflow_frame c_frame = InC(frame);
    disflow_estimate estimate;
    EXPECT_EQ(disflow_process(in_c.get(), &c_frame, &estimate), estimate.status);
    ExpectSame(estimate, expected);
  }
}

TEST(CTracker, PixelsOfTheObject_AreThoseOfTheCppTracker) {
  const DepthScene scene = BoxAt(0.0F);
  const auto tracker = std::make_unique<Tracker<profiles::Micro>>();
  TrackerInC in_c;
  Estimate expected;
  (void)tracker->Process(scene.frame(), expected);
  const disflow_frame frame = InC(scene.frame());
  disflow_estimate estimate;
  ASSERT_EQ(disflow_process(in_c.get(), &frame, &estimate), DISFLOW_OK);
  constexpr int kStride = 200;
  std::vector<std::uint8_t> mask(kStride * 120, 7);
  ASSERT_EQ(disflow_object_mask(in_c.get(), mask.data(), 160, 120, kStride), DISFLOW_OK);
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < kStride; ++u) {
      const int expected_value = u >= 160 ? 7 : tracker->last_mask().Test(u, v) ? 255 : 0;
      ASSERT_EQ(mask[static_cast<std::size_t>(v * kStride + u)], expected_value) << u << " " << v;
    }
  }
}

TEST(CTracker, RefusedFrame_HoldsNoPoseAndLeavesTheTrackerAsItWas) {
  TrackerInC in_c;
  const DepthScene scene = BoxAt(0.0F);
  disflow_frame frame = InC(scene.frame());
  frame.stamp_ns = StampOf(0);
  disflow_estimate estimate;
  ASSERT_EQ(disflow_process(in_c.get(), &frame, &estimate), DISFLOW_OK);
  frame.width_px = 5000;
  frame.stamp_ns = StampOf(1);
  EXPECT_EQ(disflow_process(in_c.get(), &frame, &estimate), DISFLOW_IMAGE_TOO_LARGE);
  frame = InC(scene.frame());
  frame.stamp_ns = StampOf(2);
  disflow_pose nowhere{{0, 0, 0}, {0, 0, 0, 2}};
  frame.T_wc = &nowhere;
  EXPECT_EQ(disflow_process(in_c.get(), &frame, &estimate), DISFLOW_INVALID_TRANSFORM);
  nowhere.quaternion_xyzw[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(disflow_process(in_c.get(), &frame, &estimate), DISFLOW_INVALID_TRANSFORM);
  const DepthScene later = BoxAt(1.0F / 30.0F);
  frame.depth = later.frame().depth.data;
  nowhere.quaternion_xyzw[3] = 1.0F;
  nowhere.position_m[0] = 3.0F;
  EXPECT_EQ(disflow_process(in_c.get(), &frame, &estimate), DISFLOW_OK);
  ASSERT_EQ(estimate.has_T_wo, 1);
  EXPECT_NEAR(estimate.T_wo.position_m[0], estimate.T_co.position_m[0] + 3.0F, 1e-5F);
  EXPECT_EQ(estimate.reset_counter, 0);
}

TEST(CTracker, MemoryThatWillNotDo_IsRefusedAndNotTouched) {
  const std::size_t bytes = disflow_tracker_bytes(&disflow_micro);
  std::vector<std::uint64_t> memory(bytes / 8 + 1, 0x0123456789ABCDEF);
  disflow_tracker* tracker = reinterpret_cast<disflow_tracker*>(memory.data());
  EXPECT_EQ(disflow_create(&disflow_micro, memory.data(), bytes - 1, nullptr, 0, &tracker, nullptr),
            DISFLOW_CAPACITY_EXCEEDED);
  EXPECT_EQ(tracker, nullptr);
  auto* const odd = reinterpret_cast<unsigned char*>(memory.data()) + 4;
  EXPECT_EQ(disflow_create(&disflow_micro, odd, bytes, nullptr, 0, &tracker, nullptr),
            DISFLOW_CAPACITY_EXCEEDED);
  for (const std::uint64_t word : memory) ASSERT_EQ(word, 0x0123456789ABCDEFU);
}

TEST(CTracker, NullPointers_AreRefused) {
  TrackerInC in_c;
  const DepthScene scene = BoxAt(0.0F);
  const disflow_frame frame = InC(scene.frame());
  const disflow_pose pose{{0, 0, 0}, {0, 0, 0, 1}};
  disflow_estimate estimate;
  disflow_tracker* tracker = nullptr;
  EXPECT_EQ(disflow_create(nullptr, &estimate, 1, nullptr, 0, &tracker, nullptr),
            DISFLOW_NOT_INITIALISED);
  EXPECT_EQ(disflow_create(&disflow_micro, nullptr, 1, nullptr, 0, &tracker, nullptr),
            DISFLOW_NOT_INITIALISED);
  EXPECT_EQ(disflow_process(nullptr, &frame, &estimate), DISFLOW_NOT_INITIALISED);
  EXPECT_EQ(disflow_process(in_c.get(), nullptr, &estimate), DISFLOW_NOT_INITIALISED);
  EXPECT_EQ(disflow_process(in_c.get(), &frame, nullptr), DISFLOW_NOT_INITIALISED);
  EXPECT_EQ(disflow_fuse(in_c.get(), &frame, nullptr, &estimate), DISFLOW_NOT_INITIALISED);
  EXPECT_EQ(disflow_fuse(nullptr, &frame, &pose, &estimate), DISFLOW_NOT_INITIALISED);
  EXPECT_EQ(disflow_object_mask(in_c.get(), nullptr, 1, 1, 0), DISFLOW_NOT_INITIALISED);
  disflow_reset(nullptr);
}

TEST(CTracker, Reset_StartsAnewObject) {
  TrackerInC in_c;
  disflow_estimate estimate;
  for (int i = 0; i < 2; ++i) {
    const DepthScene scene = BoxAt(0.0F);
    disflow_frame frame = InC(scene.frame());
    frame.stamp_ns = StampOf(i);
    ASSERT_EQ(disflow_process(in_c.get(), &frame, &estimate), DISFLOW_OK);
    EXPECT_EQ(estimate.reset_counter, i);
    disflow_reset(in_c.get());
  }
}

TEST(CTracker, MemoryThatTheHeaderPromisesToSuffice_Does) {
  EXPECT_LE(disflow_tracker_bytes(&disflow_micro), DISFLOW_MICRO_BYTES);
  EXPECT_LE(disflow_tracker_bytes(&disflow_edge), DISFLOW_EDGE_BYTES);
  EXPECT_LE(disflow_tracker_bytes(&disflow_dense), DISFLOW_DENSE_BYTES);
  for (const disflow_profile* profile : {&disflow_micro, &disflow_edge, &disflow_dense}) {
    EXPECT_LE(disflow_workspace_bytes(profile), DISFLOW_WORKSPACE_BYTES);
    EXPECT_GT(disflow_max_width_px(profile), disflow_max_height_px(profile));
  }
  EXPECT_STREQ(disflow_profile_name(&disflow_edge), "Edge");
}

TEST(CTracker, EveryNumber_IsDescribed) {
  EXPECT_STREQ(disflow_describe(DISFLOW_OK), Describe(Status::kOk));
  EXPECT_STREQ(disflow_describe(DISFLOW_REPEATED_IMAGE), Describe(Status::kRepeatedImage));
  for (const int status : {-1, 200, 256, 1 << 20}) {
    ASSERT_NE(disflow_describe(status), nullptr);
    EXPECT_NE(std::string(disflow_describe(status)), disflow_describe(DISFLOW_OK));
  }
}

TEST(CTracker, Version_IsTheProjects) {
  EXPECT_STREQ(disflow_version(), DISFLOW_PROJECT_VERSION);
  EXPECT_STREQ(DISFLOW_VERSION_TEXT, DISFLOW_PROJECT_VERSION);
}

TEST(CTracker, ChosenPlace_IsWhereTheNextObjectStarts) {
  TrackerInC tracker;
  disflow_estimate estimate;
  auto depth_of_next_m = [&, frame = 0]() mutable {
    // No two images are the same to the bit.
    DepthScene scene(1.5F + 1e-5F * static_cast<float>(frame));
    scene.Rectangle({20, 30, 60, 90}, 0.5F).Rectangle({95, 30, 140, 90}, 0.7F);
    DepthFrame image = scene.frame();
    image.stamp_ns = StampOf(frame++);
    const disflow_frame c = InC(image);
    EXPECT_EQ(disflow_process(tracker.get(), &c, &estimate), DISFLOW_OK);
    return estimate.T_co.position_m[2];
  };
  EXPECT_NEAR(depth_of_next_m(), 0.5F, 0.01F);
  ASSERT_EQ(disflow_choose_pixel(tracker.get(), 145, 60, 6), DISFLOW_OK);
  EXPECT_NEAR(depth_of_next_m(), 0.7F, 0.01F);
  ASSERT_EQ(disflow_choose_box(tracker.get(), 10, 20, 60, 90), DISFLOW_OK);
  EXPECT_NEAR(depth_of_next_m(), 0.5F, 0.01F);
  EXPECT_EQ(estimate.reset_counter, 2);
  for (const int wrong : {-1, 8192}) {
    EXPECT_EQ(disflow_choose_pixel(tracker.get(), wrong, 5, 0), DISFLOW_INVALID_CONFIG);
    EXPECT_EQ(disflow_choose_pixel(tracker.get(), 5, 5, 2 * wrong), DISFLOW_INVALID_CONFIG);
    EXPECT_EQ(disflow_choose_box(tracker.get(), 0, 0, 10, 2 * wrong), DISFLOW_INVALID_CONFIG);
  }
  EXPECT_EQ(disflow_choose_pixel(nullptr, 5, 5, 0), DISFLOW_NOT_INITIALISED);
  EXPECT_EQ(disflow_choose_box(nullptr, 0, 0, 10, 10), DISFLOW_NOT_INITIALISED);
  EXPECT_NEAR(depth_of_next_m(), 0.5F, 0.01F);
  EXPECT_EQ(estimate.reset_counter, 2) << "what is refused changes nothing";
}

}  // namespace
}  // namespace disflow::testing
