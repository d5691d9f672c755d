// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/camera_pose_history.h"

#include "disflow/saturating.h"

namespace disflow::hal {
namespace {

using BodyPose = Transform<World, Body, double>;

bool IsRigid(const BodyPose& pose) noexcept {
  constexpr double kTolerance = 1e-3;
  if (!pose.IsFinite()) return false;
  const Mat<double, 3, 3> gram = pose.rotation().transpose() * pose.rotation();
  return (gram - Mat<double, 3, 3>::Identity()).cwiseAbs().maxCoeff() < kTolerance &&
         pose.rotation().determinant() > 0.0;
}

/// Share 0 gives `a`, 1 gives `b`; beyond, the same screw motion goes on.
BodyPose Between(const BodyPose& a, const BodyPose& b, double share) noexcept {
  return a * Transform<Body, Body, double>::Exp(share * (a.Inverse() * b).Log());
}

}  // namespace

Status CameraPoseHistory::Add(StampNs stamp_ns, const BodyPose& T_wb,
                              std::uint8_t reset_counter) noexcept {
  if (!IsRigid(T_wb)) {
    AddSaturating(counters_.refused);
    return Status::kInvalidTransform;
  }
  if (size_ > 0 && reset_counter != reset_counter_) {
    AddSaturating(counters_.jumps);
    size_ = 0;
  }
  if (size_ > 0 && stamp_ns <= Newest(0).stamp_ns) {
    AddSaturating(counters_.refused);
    return Status::kStampNotIncreasing;
  }
  reset_counter_ = reset_counter;
  poses_[next_] = {stamp_ns, T_wb};
  next_ = (next_ + 1) % kCapacity;
  if (size_ < kCapacity) ++size_;
  AddSaturating(counters_.poses);
  return Status::kOk;
}

Status CameraPoseHistory::At(StampNs stamp_ns, Transform<World, Camera>& T_wc) noexcept {
  BodyPose T_wb;
  if (!Find(stamp_ns, T_wb)) {
    AddSaturating(counters_.unmatched);
    return Status::kNotFound;
  }
  AddSaturating(counters_.matched);
  T_wc = (T_wb * settings_.T_bc.Cast<double>()).Cast<float>();
  return Status::kOk;
}

bool CameraPoseHistory::Find(StampNs stamp_ns, BodyPose& T_wb) noexcept {
  if (size_ < 2 || stamp_ns < Newest(size_ - 1).stamp_ns) return false;
  // Most stamps are close to the newest.
  std::size_t later = 0;
  while (later + 2 < size_ && Newest(later + 1).stamp_ns >= stamp_ns) ++later;
  const Stamped& a = Newest(later + 1);
  const Stamped& b = Newest(later);
  // Stamps of a damaged sender may be anything, so differences are taken unsigned.
  const auto gap = static_cast<std::uint64_t>(b.stamp_ns) - static_cast<std::uint64_t>(a.stamp_ns);
  if (gap > static_cast<std::uint64_t>(settings_.max_gap_ns)) return false;
  if (stamp_ns > b.stamp_ns) {
    const auto ahead =
        static_cast<std::uint64_t>(stamp_ns) - static_cast<std::uint64_t>(b.stamp_ns);
    if (ahead > static_cast<std::uint64_t>(settings_.max_ahead_ns)) return false;
    AddSaturating(counters_.continued);
  }
  const auto since = static_cast<std::uint64_t>(stamp_ns) - static_cast<std::uint64_t>(a.stamp_ns);
  T_wb = Between(a.T_wb, b.T_wb, static_cast<double>(since) / static_cast<double>(gap));
  return true;
}

}  // namespace disflow::hal
