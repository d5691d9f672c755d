// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/target_telemetry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace disflow::hal::mavlink {
namespace {

template <class Rotation>
std::array<float, 4> QuaternionOf(const Rotation& rotation) noexcept {
  Eigen::Quaternion<float, Eigen::DontAlign> q(rotation);
  q.normalize();
  if (q.w() < 0.0F) q.coeffs() = -q.coeffs();
  return {q.w(), q.x(), q.y(), q.z()};
}

/// Radii of the Earth by which short ways north and east become angles at its centre.
struct Curvature {
  double north_m;
  double east_m;
};

/// WGS84's radii of curvature in the meridian and across it.
Curvature CurvatureAt(double latitude_rad) noexcept {
  constexpr double kSemiMajorAxis_m = 6'378'137.0;
  constexpr double kFlattening = 1.0 / 298.257'223'563;
  constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
  const double sine = std::sin(latitude_rad);
  const double root = std::sqrt(1.0 - kEccentricity2 * sine * sine);
  return {kSemiMajorAxis_m * (1.0 - kEccentricity2) / (root * root * root),
          kSemiMajorAxis_m / root};
}

constexpr double kRadPerUnit = std::numbers::pi / 180.0 * 1e-7;  ///< Units of 1e-7 degrees.

struct Place {
  double latitude_rad;
  double longitude_rad;
};

/// The place that lies so far from another, along a great circle: the azimuthal equidistant
/// projection by which autopilots make their local frames, backwards.
Place PlaceFrom(const Place& origin, double north_m, double east_m, double height_m) noexcept {
  const Curvature radius = CurvatureAt(origin.latitude_rad);
  const double north_rad = north_m / (radius.north_m + height_m);
  const double east_rad = east_m / (radius.east_m + height_m);
  const double arc_rad = std::hypot(north_rad, east_rad);
  if (arc_rad == 0.0) return origin;
  const double sine = std::sin(arc_rad) / arc_rad;
  const double up = std::sin(origin.latitude_rad);
  const double out = std::cos(origin.latitude_rad);
  return {std::asin(std::clamp(std::cos(arc_rad) * up + north_rad * sine * out, -1.0, 1.0)),
          origin.longitude_rad +
              std::atan2(east_rad * sine, out * std::cos(arc_rad) - north_rad * up * sine)};
}

std::int32_t UnitsOf(double angle_rad) noexcept {
  // Beyond the date line the other half begins.
  const double wrapped_rad = std::remainder(angle_rad, 2.0 * std::numbers::pi);
  return static_cast<std::int32_t>(std::lround(wrapped_rad / kRadPerUnit));
}

/// East-north-up to north-east-down; the same matrix the other way round.
Mat3 RotationNedFromEnu() noexcept {
  Mat3 rotation;
  rotation << 0.0F, 1.0F, 0.0F,  //
      1.0F, 0.0F, 0.0F,          //
      0.0F, 0.0F, -1.0F;
  return rotation;
}

}  // namespace

Expected<LandingTarget> MakeLandingTarget(const Estimate& estimate,
                                          const Transform<Body, Camera>& T_bc, MavFrame world,
                                          std::uint8_t target_num) noexcept {
  if (KindOf(estimate) != EstimateKind::kMeasured) return {{}, Status::kNotInitialised};
  const Vec3 in_camera_m = estimate.T_co.translation();
  LandingTarget target;
  target.time_usec = MicrosecondsOf(estimate.stamp_ns);
  target.angle_x = std::atan2(in_camera_m.x(), in_camera_m.z());
  target.angle_y = std::atan2(in_camera_m.y(), in_camera_m.z());
  target.distance = in_camera_m.norm();
  target.target_num = target_num;
  const bool in_world = estimate.has_T_wo && world == MavFrame::kLocalNed;
  target.frame = static_cast<std::uint8_t>(in_world ? MavFrame::kLocalNed : MavFrame::kBodyFrd);
  const Transform<Body, Object> T_bo = T_bc * estimate.T_co;
  const Vec3 position_m = in_world ? estimate.T_wo.translation() : T_bo.translation();
  target.q = in_world ? QuaternionOf(estimate.T_wo.rotation()) : QuaternionOf(T_bo.rotation());
  target.x = position_m.x();
  target.y = position_m.y();
  target.z = position_m.z();
  target.position_valid = 1;
  return {target};
}

void EarthOrigin::Take(const FrameView& frame) noexcept {
  constexpr std::int32_t kQuarter = 900'000'000;
  GpsGlobalOrigin origin;
  if (DecodePayload(frame, origin) != Status::kOk) return;
  if (frame.header.system_id != system_id_) return;
  if (origin.latitude < -kQuarter || origin.latitude > kQuarter) return;
  if (origin.longitude < -2 * kQuarter || origin.longitude > 2 * kQuarter) return;
  origin_ = origin;
  known_ = true;
}

Expected<FollowTarget> MakeFollowTarget(const Estimate& estimate, MavFrame world,
                                        const EarthOrigin& earth) noexcept {
  // Far beyond what a camera's carrier flies from where it started.
  constexpr float kFarthest_m = 100'000.0F;
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  if (KindOf(estimate) != EstimateKind::kMeasured || !estimate.has_T_wo || !earth.known()) {
    return {{}, Status::kNotInitialised};
  }
  const Mat3 R_nw = world == MavFrame::kLocalEnu ? RotationNedFromEnu() : Mat3(Mat3::Identity());
  const Vec3 ned_m = R_nw * estimate.T_wo.translation();
  // Written so that NaN fails.
  if (!(ned_m.norm() < kFarthest_m)) return {{}, Status::kInvalidTransform};
  const double height_m = 1e-3 * earth.origin().altitude;
  const Place place =
      PlaceFrom({kRadPerUnit * earth.origin().latitude, kRadPerUnit * earth.origin().longitude},
                static_cast<double>(ned_m.x()), static_cast<double>(ned_m.y()), height_m);
  FollowTarget target;
  target.timestamp = MicrosecondsOf(estimate.stamp_ns) / 1000;
  target.lat = UnitsOf(place.latitude_rad);
  target.lon = UnitsOf(place.longitude_rad);
  target.alt = static_cast<float>(height_m) - ned_m.z();
  target.vel.fill(kUnknown);
  target.acc.fill(kUnknown);
  target.rates.fill(kUnknown);
  target.attitude_q = QuaternionOf(R_nw * estimate.T_wo.rotation());
  const Mat3 R_nc = R_nw * estimate.T_wo.rotation() * estimate.T_co.rotation().transpose();
  const Mat3 covariance =
      R_nc * estimate.pose_covariance.template topLeftCorner<3, 3>() * R_nc.transpose();
  target.position_cov = {std::sqrt(covariance(0, 0) + covariance(1, 1)),
                         std::sqrt(covariance(2, 2)), kUnknown};
  target.est_capabilities = FollowTarget::kHasPosition;
  return {target};
}

}  // namespace disflow::hal::mavlink
