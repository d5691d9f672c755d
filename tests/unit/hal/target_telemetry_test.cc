// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/target_telemetry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "message_line.h"
#include "wire_samples.h"

namespace disflow::hal::mavlink {
namespace {

constexpr std::uint8_t kVehicle = 1;

/// Optical axes (right, down, forward) of a camera that looks ahead, in a vehicle's.
Mat3 LooksAhead() {
  Mat3 rotation;
  rotation << 0.0F, 0.0F, 1.0F,  //
      1.0F, 0.0F, 0.0F,          //
      0.0F, 1.0F, 0.0F;
  return rotation;
}

Estimate Measured(const Vec3& in_camera_m) {
  Estimate estimate;
  estimate.status = Status::kOk;
  estimate.state = TrackingState::kTracking;
  estimate.stamp_ns = 1'234'567'890;
  estimate.T_co = PoseCameraFromObject(Mat3(Mat3::Identity()), in_camera_m);
  estimate.pose_covariance = 1e-6F * Mat6::Identity();
  estimate.twist_covariance = 1e-4F * Mat6::Identity();
  estimate.quality = 90;
  return estimate;
}

Transform<Body, Camera> Mount() {
  return Transform<Body, Camera>(LooksAhead(), Vec3(0.1F, 0.0F, -0.05F));
}

TEST(LandingTarget, WithoutAWorld_IsInTheVehicle) {
  const auto made =
      MakeLandingTarget(Measured({0.3F, -0.2F, 2.0F}), Mount(), MavFrame::kLocalFrd, 3);
  ASSERT_TRUE(made.ok());
  const LandingTarget& target = made.value;
  EXPECT_EQ(target.time_usec, 1'234'567U);
  EXPECT_EQ(target.frame, 12);
  EXPECT_EQ(target.position_valid, 1);
  EXPECT_EQ(target.target_num, 3);
  EXPECT_EQ(target.type, 3);
  // Ahead, right and up of the vehicle's origin.
  EXPECT_NEAR(target.x, 2.1F, 1e-5F);
  EXPECT_NEAR(target.y, 0.3F, 1e-5F);
  EXPECT_NEAR(target.z, -0.25F, 1e-5F);
  EXPECT_NEAR(target.distance, std::sqrt(0.09F + 0.04F + 4.0F), 1e-5F);
  EXPECT_NEAR(std::tan(target.angle_x), 0.15F, 1e-6F);
  EXPECT_NEAR(std::tan(target.angle_y), -0.1F, 1e-6F);
  EXPECT_NEAR(target.q[0], 0.5F, 1e-6F);
}

TEST(LandingTarget, WithAWorldThatIsNorthEastDown_IsThere) {
  Estimate estimate = Measured({0.0F, 0.0F, 1.0F});
  estimate.has_T_wo = true;
  estimate.T_wo = Transform<World, Object>(Mat3(Mat3::Identity()), Vec3(5.0F, 6.0F, -7.0F));
  const auto ned = MakeLandingTarget(estimate, Mount(), MavFrame::kLocalNed, 0);
  ASSERT_TRUE(ned.ok());
  EXPECT_EQ(ned.value.frame, 1);
  EXPECT_FLOAT_EQ(ned.value.x, 5.0F);
  EXPECT_FLOAT_EQ(ned.value.y, 6.0F);
  EXPECT_FLOAT_EQ(ned.value.z, -7.0F);
  EXPECT_FLOAT_EQ(ned.value.q[0], 1.0F);
  EXPECT_FLOAT_EQ(ned.value.distance, 1.0F);
  const auto enu = MakeLandingTarget(estimate, Mount(), MavFrame::kLocalEnu, 0);
  EXPECT_EQ(enu.value.frame, 12);
}

TEST(Targets, WhatIsNotMeasured_IsNotSent) {
  EarthOrigin earth(kVehicle);
  for (const Status status : {Status::kRegistrationFailed, Status::kStampNotIncreasing}) {
    Estimate estimate = Measured({0.0F, 0.0F, 1.0F});
    estimate.has_T_wo = true;
    estimate.status = status;
    EXPECT_FALSE(MakeLandingTarget(estimate, Mount(), MavFrame::kLocalNed, 0).ok());
    EXPECT_FALSE(MakeFollowTarget(estimate, MavFrame::kLocalNed, earth).ok());
  }
}

/// An origin on Earth, and an object in the vehicle's world.
class FollowTargetTest : public ::testing::Test {
 protected:
  void SetOrigin(double latitude_deg, double longitude_deg, double altitude_m,
                 std::uint8_t system_id = kVehicle) {
    GpsGlobalOrigin origin;
    origin.latitude = static_cast<std::int32_t>(std::lround(latitude_deg * 1e7));
    origin.longitude = static_cast<std::int32_t>(std::lround(longitude_deg * 1e7));
    origin.altitude = static_cast<std::int32_t>(std::lround(altitude_m * 1e3));
    const FrameHeader sender{.sequence = 0, .system_id = system_id, .component_id = 1};
    test::MessageLine(earth_).Deliver(testing::Encoded(origin, sender));
  }
  [[nodiscard]] Expected<FollowTarget> At(const Vec3& in_world_m,
                                          MavFrame world = MavFrame::kLocalNed) const {
    Estimate estimate = Measured({0.0F, 0.0F, 1.0F});
    estimate.has_T_wo = true;
    estimate.T_wo = Transform<World, Object>(Mat3(Mat3::Identity()), in_world_m);
    // Of the position, in camera axes, which here are the world's.
    estimate.pose_covariance.diagonal().head<3>() = Vec3(9e-4F, 16e-4F, 4e-4F);
    return MakeFollowTarget(estimate, world, earth_);
  }

  EarthOrigin earth_{kVehicle};
};

TEST_F(FollowTargetTest, OriginNotKnownOrOfAnother_GivesNothing) {
  EXPECT_EQ(At({1.0F, 2.0F, 3.0F}).status, Status::kNotInitialised);
  SetOrigin(47.0, 8.0, 400.0, kVehicle + 1);
  EXPECT_EQ(At({1.0F, 2.0F, 3.0F}).status, Status::kNotInitialised);
  SetOrigin(91.0, 8.0, 400.0);
  EXPECT_EQ(At({1.0F, 2.0F, 3.0F}).status, Status::kNotInitialised);
}

TEST_F(FollowTargetTest, ObjectAtTheOrigin_IsThere) {
  SetOrigin(47.3977418, 8.5455939, 488.0);
  const auto target = At({0.0F, 0.0F, -12.5F});
  ASSERT_TRUE(target.ok());
  EXPECT_EQ(target.value.lat, 473'977'418);
  EXPECT_EQ(target.value.lon, 85'455'939);
  EXPECT_FLOAT_EQ(target.value.alt, 500.5F);
  EXPECT_EQ(target.value.timestamp, 1234U);
  EXPECT_EQ(target.value.est_capabilities, 1);
  EXPECT_TRUE(std::isnan(target.value.vel[0]));
  EXPECT_NEAR(target.value.position_cov[0], 0.05F, 1e-6F);
  EXPECT_NEAR(target.value.position_cov[1], 0.02F, 1e-6F);
}

TEST_F(FollowTargetTest, WaysNorthAndEast_AreThoseOfTheEllipsoid) {
  // A second of arc on WGS84, as tables have it: metres north and east by latitude.
  struct Row {
    double latitude_deg;
    float north_m;
    float east_m;
  };
  for (const Row& row :
       {Row{0.0, 30.715F, 30.922F}, Row{45.0, 30.870F, 21.903F}, Row{60.0, 30.948F, 15.500F}}) {
    SetOrigin(row.latitude_deg, 10.0, 0.0);
    constexpr double kSecondOfArc = 1e7 / 3600.0;
    const auto north = At({row.north_m, 0.0F, 0.0F});
    EXPECT_NEAR(north.value.lat - row.latitude_deg * 1e7, kSecondOfArc, 2.0) << row.latitude_deg;
    const auto east = At({0.0F, row.east_m, 0.0F});
    EXPECT_NEAR(east.value.lon - 1e8, kSecondOfArc, 2.0) << row.latitude_deg;
    const auto enu = At({row.east_m, row.north_m, 5.0F}, MavFrame::kLocalEnu);
    EXPECT_NEAR(enu.value.lat, north.value.lat, 1.0);
    EXPECT_NEAR(enu.value.lon, east.value.lon, 1.0);
    EXPECT_NEAR(enu.value.alt, 5.0F, 1e-4F);
  }
}

TEST_F(FollowTargetTest, DateLineAndPoles_AreNoEdges) {
  SetOrigin(10.0, 179.9999, 0.0);
  EXPECT_LT(At({0.0F, 100.0F, 0.0F}).value.lon, -1'799'000'000);
  SetOrigin(89.9999, 0.0, 0.0);
  const auto beyond = At({100.0F, 0.0F, 0.0F});
  ASSERT_TRUE(beyond.ok());
  EXPECT_NEAR(std::abs(beyond.value.lon), 1'800'000'000.0, 10.0);
  EXPECT_LT(beyond.value.lat, 900'000'000);
  EXPECT_GT(beyond.value.lat, 899'990'000);
}

TEST_F(FollowTargetTest, FartherThanAnythingFlies_IsRefused) {
  SetOrigin(47.0, 8.0, 400.0);
  EXPECT_EQ(At({200'000.0F, 0.0F, 0.0F}).status, Status::kInvalidTransform);
  EXPECT_FALSE(At({std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F}).ok());
}

}  // namespace
}  // namespace disflow::hal::mavlink
