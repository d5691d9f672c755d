// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "disflow/host/depth_renderer.h"
#include "disflow/host/object_meshes.h"
#include "disflow/tracker.h"

namespace disflow::testing {
namespace {

constexpr int kWidth_px = 320;
constexpr int kHeight_px = 180;
constexpr PinholeCamera kCamera{300.0F, 300.0F, 159.5F, 89.5F};
constexpr double kFps = 30.0;
constexpr double kDistance_m = 0.4;
/// The image shows 0.42 m of what is so far away.
constexpr double kHalfLength_m = 0.3;
constexpr double kNoise_m = 3e-4;

/// A bar that reaches out of the image and moves along itself: nothing but its ends tells where it
/// is. It turns a little, since an outline that is the same to the pixel in every image stands
/// still.
class Bar {
 public:
  /// @param place_m Of its middle at a time, to the right.
  explicit Bar(std::function<double(double)> place_m)
      : place_m_(std::move(place_m)),
        mesh_(host::MakeRoundedCuboid(host::Vec3d(kHalfLength_m, 0.04, 0.03), 0.002)),
        renderer_(kCamera, kWidth_px, kHeight_px),
        tracker_(std::make_unique<Tracker<profiles::Edge>>()) {}

  void Run(double until_s) {
    for (; static_cast<double>(frame_) < until_s * kFps; ++frame_) Step();
  }
  [[nodiscard]] const Estimate& estimate() const { return estimate_; }
  /// How far it is said to be from where it is, along itself.
  [[nodiscard]] double off_m() const {
    return Along(estimate_.T_co.translation()) - place_m_(now_s_) - start_m_;
  }
  [[nodiscard]] double std_m() const {
    const Vec3 axis = Axis().cast<float>();
    const Mat3 position = estimate_.pose_covariance.topLeftCorner<3, 3>();
    return std::sqrt(static_cast<double>(axis.dot(position * axis)));
  }
  [[nodiscard]] double speed_mps() const { return Along(estimate_.twist.linear_mps); }

 private:
  void Step() {
    now_s_ = static_cast<double>(frame_) / kFps;
    Draw();
    DepthFrame frame;
    frame.camera = kCamera;
    frame.stamp_ns = 1'000'000'000 + std::llround(now_s_ * 1e9);
    frame.depth.data = depth_.data();
    frame.depth.width_px = kWidth_px;
    frame.depth.height_px = kHeight_px;
    frame.depth.stride_bytes = kWidth_px * static_cast<std::ptrdiff_t>(sizeof(float));
    frame.depth.format = DepthFormat::kFloat32;
    frame.mask = {mask_.data(), kWidth_px, kHeight_px, kWidth_px};
    (void)tracker_->Process(frame, estimate_);
    if (frame_ == 0) {
      start_m_ = Along(estimate_.T_co.translation()) - place_m_(now_s_);
    }
  }

  [[nodiscard]] host::Mat3d Rotation() const {
    // Two faces are seen.
    const Eigen::AngleAxisd tilt(0.6, host::Vec3d::UnitX());
    const Eigen::AngleAxisd turn(0.2 + 0.1 * std::sin(1.3 * now_s_), host::Vec3d::UnitZ());
    return (turn * tilt).toRotationMatrix();
  }
  [[nodiscard]] host::Vec3d Axis() const { return Rotation().col(0); }
  [[nodiscard]] double Along(const Vec3& x_c) const { return Axis().dot(x_c.cast<double>()); }

  void Draw() {
    const Transform<Camera, Object, double> T_cm(
        Rotation(), host::Vec3d(place_m_(now_s_) * Axis() + kDistance_m * host::Vec3d::UnitZ()));
    renderer_.Clear();
    renderer_.DrawPlane({host::Vec3d::UnitZ(), 1.2});
    renderer_.DrawMesh(mesh_, T_cm, 1);
    const auto seen = renderer_.inverse_depth_per_m();
    std::normal_distribution<double> noise(0.0, kNoise_m);
    depth_.resize(seen.size());
    mask_.resize(seen.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      depth_[i] = static_cast<float>(1.0 / static_cast<double>(seen[i]) + noise(random_));
      mask_[i] = renderer_.labels()[i] == 1 ? 255 : 0;
    }
  }

  std::function<double(double)> place_m_;
  host::TriangleMesh mesh_;
  host::DepthRenderer renderer_;
  std::unique_ptr<Tracker<profiles::Edge>> tracker_;
  std::vector<float> depth_;
  std::vector<std::uint8_t> mask_;
  std::mt19937 random_{1};
  Estimate estimate_;
  int frame_ = 0;
  double now_s_ = 0.0;
  double start_m_ = 0.0;
};

/// At rest, then as fast as said, from 0.5 s on.
double Moved(double from_m, double speed_mps, double now_s) {
  return from_m + speed_mps * std::max(now_s - 0.5, 0.0);
}

// What it slid by before its end came into view nobody knows, however well the end holds it since.
TEST(SlidBar, EndThatIsSeenForTheFirstTime_DoesNotMakeItsPlaceKnown) {
  Bar bar([](double now_s) { return Moved(0.0, -0.06, now_s); });
  constexpr double kEndInView_s = 2.2;
  bar.Run(kEndInView_s - 0.2);
  ASSERT_EQ(bar.estimate().state, TrackingState::kDegraded);
  for (double now_s = kEndInView_s; now_s < 4.5; now_s += 0.1) {
    bar.Run(now_s);
    ASSERT_EQ(bar.estimate().status, Status::kOk);
    EXPECT_LT(std::abs(bar.off_m()), 2.0 * bar.std_m()) << "at " << now_s << " s";
    EXPECT_NE(bar.estimate().state, TrackingState::kTracking) << "at " << now_s << " s";
  }
  ASSERT_GT(std::abs(bar.off_m()), 0.01);
  // It holds it all the same: the velocity is known again.
  EXPECT_NEAR(bar.speed_mps(), -0.06, 0.01);
  EXPECT_LT(bar.estimate().twist_covariance(0, 0), 0.02F * 0.02F);
}

// The end was seen at the start, goes out of view and comes back when the bar has moved.
TEST(SlidBar, EndThatWasKnown_IsFoundAgainWhenItIsBackInView) {
  Bar bar([](double now_s) {
    const double away_s = std::clamp(now_s - 0.5, 0.0, 0.8) - std::clamp(now_s - 2.5, 0.0, 0.8);
    return -0.15 + 0.2 * away_s;
  });
  bar.Run(0.5);
  ASSERT_EQ(bar.estimate().state, TrackingState::kTracking);
  bar.Run(2.5);
  ASSERT_EQ(bar.estimate().state, TrackingState::kDegraded);
  EXPECT_LT(std::abs(bar.off_m()), 2.0 * bar.std_m());
  bar.Run(4.3);
  EXPECT_LT(std::abs(bar.off_m()), 0.002);
  EXPECT_EQ(bar.estimate().state, TrackingState::kTracking);
  EXPECT_LT(bar.std_m(), 0.002);
}

}  // namespace
}  // namespace disflow::testing
