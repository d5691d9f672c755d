// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/camera_pose_input.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "disflow/saturating.h"

namespace disflow::hal::mavlink {
namespace {

/// @return false if the rotation is none.
bool ToPose(const Odometry& odometry, Transform<World, Body, double>& T_wb) noexcept {
  const Eigen::Quaternion<double, Eigen::DontAlign> q(
      static_cast<double>(odometry.q[0]), static_cast<double>(odometry.q[1]),
      static_cast<double>(odometry.q[2]), static_cast<double>(odometry.q[3]));
  // Written so that NaN fails.
  const double norm = q.norm();
  if (!(norm > 0.9 && norm < 1.1)) return false;
  T_wb = {q, Mat<double, 3>(static_cast<double>(odometry.x), static_cast<double>(odometry.y),
                            static_cast<double>(odometry.z))};
  return T_wb.IsFinite();
}

}  // namespace

void CameraPoseInput::Take(const FrameView& frame, std::int64_t now_ns) noexcept {
  Odometry odometry;
  if (DecodePayload(frame, odometry) != Status::kOk) return;
  if (frame.header.system_id != source_.system_id) {
    AddSaturating(counters_.other_system);
    return;
  }
  if (odometry.frame_id != static_cast<std::uint8_t>(source_.world)) {
    AddSaturating(counters_.other_frame);
    refused_frame_ = odometry.frame_id;
    return;
  }
  Transform<World, Body, double> T_wb;
  if (odometry.quality == Odometry::kQualityFailed || !ToPose(odometry, T_wb)) {
    AddSaturating(counters_.failed);
    return;
  }
  const Expected<StampNs> stamp = ToCaptureClock(odometry.time_usec, now_ns);
  if (!stamp.ok()) {
    history_->RefuseStamp();
    return;
  }
  // Refused poses are counted there.
  (void)history_->Add(stamp.value, T_wb, odometry.reset_counter, now_ns);
}

Expected<StampNs> CameraPoseInput::ToCaptureClock(std::uint64_t time_usec,
                                                  std::int64_t now_ns) noexcept {
  constexpr auto kMax_us =
      static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() / 4000);
  const auto stamp_ns = static_cast<std::int64_t>(std::min(time_usec, kMax_us)) * 1000;
  if (!source_.own_clock) return {stamp_ns};
  return clock_.ToOwn(stamp_ns, now_ns);
}

}  // namespace disflow::hal::mavlink
