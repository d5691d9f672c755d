// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "disflow/hal/mavlink/telemetry.h"

/// @file
/// ODOMETRY's frames against a computation of its own: double precision, frames turned by a
/// quaternion, covariances by sampled sigma points instead of block products.

namespace disflow::hal::mavlink {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double kTolerance = 2e-6;

/// Camera optical axes to forward-right-down, by the meaning of the axes.
Vector3d FrdFromOptical(const Vector3d& optical) {
  const double right = optical.x();
  const double down = optical.y();
  const double forward = optical.z();
  return {forward, right, down};
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double Number() { return distribution_(engine_); }
  Vector3d Vector() { return {Number(), Number(), Number()}; }
  Quaterniond Rotation() {
    return Quaterniond(Number(), Number(), Number(), Number()).normalized();
  }
  Matrix6d Covariance() {
    const Matrix6d root = Matrix6d::NullaryExpr([this] { return 0.1 * Number(); });
    return root * root.transpose();
  }

 private:
  std::mt19937 engine_;
  std::normal_distribution<double> distribution_;
};

struct Truth {
  explicit Truth(unsigned seed) {
    Random random(seed);
    q_co = random.Rotation();
    p_co = random.Vector();
    q_wc = random.Rotation();
    p_wc = random.Vector();
    v = random.Vector();
    w = random.Vector();
    pose_covariance = random.Covariance();
    twist_covariance = random.Covariance();
  }

  [[nodiscard]] Estimate MakeEstimate() const {
    Estimate estimate;
    estimate.status = Status::kOk;
    estimate.state = TrackingState::kTracking;
    estimate.quality = 80;
    estimate.T_co = {Mat3(q_co.toRotationMatrix().cast<float>()), Vec3(p_co.cast<float>())};
    estimate.has_T_wo = true;
    estimate.T_wo = {Mat3((q_wc * q_co).toRotationMatrix().cast<float>()),
                     Vec3((q_wc * p_co + p_wc).cast<float>())};
    estimate.twist = {v.cast<float>(), w.cast<float>()};
    estimate.pose_covariance = pose_covariance.cast<float>();
    estimate.twist_covariance = twist_covariance.cast<float>();
    return estimate;
  }

  Quaterniond q_co, q_wc;
  Vector3d p_co, p_wc, v, w;
  Matrix6d pose_covariance, twist_covariance;
};

Matrix6d Unpacked(const std::array<float, 21>& packed) {
  Matrix6d full;
  int next = 0;
  for (int row = 0; row < 6; ++row) {
    for (int col = row; col < 6; ++col) {
      full(row, col) = full(col, row) = static_cast<double>(packed[static_cast<size_t>(next++)]);
    }
  }
  return full;
}

/// Covariance of the turned vectors, summed over the columns of a matrix root.
template <class Turn>
Matrix6d Turned(const Matrix6d& covariance, Turn&& turn) {
  const Matrix6d root = covariance.llt().matrixL();
  Matrix6d sum = Matrix6d::Zero();
  for (int col = 0; col < 6; ++col) {
    Eigen::Matrix<double, 6, 1> turned;
    turned.head<3>() = turn(Vector3d(root.col(col).head<3>()));
    turned.tail<3>() = turn(Vector3d(root.col(col).tail<3>()));
    sum += turned * turned.transpose();
  }
  return sum;
}

Quaterniond RotationOf(const Odometry& odometry) {
  return {static_cast<double>(odometry.q[0]), static_cast<double>(odometry.q[1]),
          static_cast<double>(odometry.q[2]), static_cast<double>(odometry.q[3])};
}

Vector3d PositionOf(const Odometry& odometry) {
  return Eigen::Vector3f(odometry.x, odometry.y, odometry.z).cast<double>();
}

/// A point of the object must come out at the same place as by way of the camera.
const Vector3d kObjectPoints[] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.2, 0}, {0, 0, 0.3}};

class OdometryFrames : public ::testing::TestWithParam<unsigned> {};

TEST_P(OdometryFrames, CameraPose_MapsObjectPointsIntoTheCamerasFrd) {
  const Truth truth(GetParam());
  const Odometry odometry = MakeOdometry(truth.MakeEstimate(), MavFrame::kBodyFrd);
  EXPECT_EQ(odometry.frame_id, 12);
  EXPECT_EQ(odometry.child_frame_id, 12);
  EXPECT_GE(odometry.q[0], 0.0F);
  for (const Vector3d& point : kObjectPoints) {
    const Vector3d expected = FrdFromOptical(truth.q_co * point + truth.p_co);
    const Vector3d actual = RotationOf(odometry) * point + PositionOf(odometry);
    EXPECT_LT((expected - actual).norm(), kTolerance);
  }
}

TEST_P(OdometryFrames, WorldPose_MapsObjectPointsIntoTheWorldAsGiven) {
  const Truth truth(GetParam());
  const Odometry odometry = MakeOdometry(truth.MakeEstimate(), MavFrame::kLocalFrd);
  EXPECT_EQ(odometry.frame_id, 20);
  EXPECT_EQ(odometry.child_frame_id, 12);
  for (const Vector3d& point : kObjectPoints) {
    const Vector3d expected = truth.q_wc * (truth.q_co * point + truth.p_co) + truth.p_wc;
    const Vector3d actual = RotationOf(odometry) * point + PositionOf(odometry);
    EXPECT_LT((expected - actual).norm(), kTolerance);
  }
}

TEST_P(OdometryFrames, Twist_IsInTheCamerasFrd) {
  const Truth truth(GetParam());
  for (const MavFrame frame : {MavFrame::kBodyFrd, MavFrame::kLocalFrd}) {
    const Odometry odometry = MakeOdometry(truth.MakeEstimate(), frame);
    const Eigen::Vector3f v(odometry.vx, odometry.vy, odometry.vz);
    const Eigen::Vector3f w(odometry.rollspeed, odometry.pitchspeed, odometry.yawspeed);
    EXPECT_LT((v.cast<double>() - FrdFromOptical(truth.v)).norm(), kTolerance);
    EXPECT_LT((w.cast<double>() - FrdFromOptical(truth.w)).norm(), kTolerance);
  }
}

TEST_P(OdometryFrames, Covariances_AreInTheFramesOfTheirValues) {
  const Truth truth(GetParam());
  const Estimate estimate = truth.MakeEstimate();
  const Odometry camera = MakeOdometry(estimate, MavFrame::kBodyFrd);
  EXPECT_LT(
      (Unpacked(camera.pose_covariance) - Turned(truth.pose_covariance, FrdFromOptical)).norm(),
      kTolerance);
  const Odometry world = MakeOdometry(estimate, MavFrame::kLocalNed);
  const auto to_world = [&](const Vector3d& x) -> Vector3d { return truth.q_wc * x; };
  EXPECT_LT((Unpacked(world.pose_covariance) - Turned(truth.pose_covariance, to_world)).norm(),
            kTolerance);
  for (const Odometry& odometry : {camera, world}) {
    EXPECT_LT(
        (Unpacked(odometry.velocity_covariance) - Turned(truth.twist_covariance, FrdFromOptical))
            .norm(),
        kTolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, OdometryFrames, ::testing::Range(1U, 13U),
                         ::testing::PrintToStringParamName());

}  // namespace
}  // namespace disflow::hal::mavlink
