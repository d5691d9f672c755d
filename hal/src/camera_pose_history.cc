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

bool CameraPoseHistory::GoesOn(StampNs from_ns, StampNs stamp_ns) const noexcept {
  const std::uint64_t step_ns = SpanNs(from_ns, stamp_ns);
  return step_ns > 0 && step_ns <= static_cast<std::uint64_t>(settings_.max_gap_ns);
}

Status CameraPoseHistory::Add(StampNs stamp_ns, const BodyPose& T_wb, std::uint8_t reset_counter,
                              std::int64_t now_ns) noexcept {
  if (!IsRigid(T_wb)) {
    AddSaturating(counters_.refused);
    return Status::kInvalidTransform;
  }
  if (SpanNs(stamp_ns, now_ns) > static_cast<std::uint64_t>(settings_.max_age_ns) ||
      SpanNs(now_ns, stamp_ns) > static_cast<std::uint64_t>(settings_.max_lead_ns)) {
    RefuseStamp();
    return Status::kStampNotIncreasing;
  }
  if (!run_.empty() && reset_counter != reset_counter_) {
    AddSaturating(counters_.jumps);
    run_.Clear();
    DropRival();
  }
  reset_counter_ = reset_counter;
  if (run_.empty() || GoesOn(run_.Newest().stamp_ns, stamp_ns)) {
    DropRival();
    run_.Push({stamp_ns, T_wb});
    AddSaturating(counters_.poses);
    return Status::kOk;
  }
  // A message that came twice, by two ways, says nothing about the others.
  const std::size_t not_older = run_.CountFrom(stamp_ns);
  if (not_older > 0 && run_.Newest(not_older - 1).stamp_ns == stamp_ns) {
    RefuseStamp();
    return Status::kStampNotIncreasing;
  }
  if (!RivalTakes({stamp_ns, T_wb})) return Status::kStampNotIncreasing;
  const bool is_newer = stamp_ns > run_.Newest().stamp_ns;
  if (RivalWins()) {
    ReplaceByRival();
    return Status::kOk;
  }
  return is_newer ? Status::kOk : Status::kStampNotIncreasing;
}

void CameraPoseHistory::RefuseStamp(std::size_t poses) noexcept {
  AddSaturating(counters_.refused, static_cast<std::uint32_t>(poses));
  AddSaturating(counters_.wrong_stamp, static_cast<std::uint32_t>(poses));
}

bool CameraPoseHistory::RivalTakes(const StampedPose& pose) noexcept {
  if (!rival_.empty() && !GoesOn(rival_.Newest().stamp_ns, pose.stamp_ns)) {
    // A wrong stamp in the midst of a rival must not cost it what it has shown; two would.
    if (rival_.size() > 1 && !rival_missed_) {
      rival_missed_ = true;
      RefuseStamp();
      return false;
    }
    DropRival();
  }
  rival_missed_ = false;
  rival_.Push(pose);
  ++held_back_;
  return true;
}

/// Whether more poses speak for the rival than against it. A sender whose clock has been set back
/// has a long past against it, so a while is enough as well; shorter than that is the lead which
/// one of two links of the same sender may have over the other.
bool CameraPoseHistory::RivalWins() const noexcept {
  constexpr std::uint64_t kWhile_ns = 300'000'000;
  if (rival_.size() < 2) return false;
  return rival_.size() > run_.CountFrom(rival_.Oldest().stamp_ns) || rival_.full() ||
         SpanNs(rival_.Oldest().stamp_ns, rival_.Newest().stamp_ns) >= kWhile_ns;
}

/// What is older than the rival stays: it is not contradicted.
void CameraPoseHistory::ReplaceByRival() noexcept {
  const std::size_t contradicted = run_.CountFrom(rival_.Oldest().stamp_ns);
  RefuseStamp(contradicted);
  for (std::size_t i = 0; i < contradicted; ++i) run_.PopNewest();
  for (std::size_t back = rival_.size(); back-- > 0;) run_.Push(rival_.Newest(back));
  AddSaturating(counters_.poses, static_cast<std::uint32_t>(held_back_));
  rival_.Clear();
  held_back_ = 0;
}

void CameraPoseHistory::DropRival() noexcept {
  RefuseStamp(held_back_);
  held_back_ = 0;
  rival_.Clear();
  rival_missed_ = false;
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
  if (run_.size() < 2 || stamp_ns < run_.Oldest().stamp_ns) return false;
  // Most stamps are close to the newest.
  std::size_t later = 0;
  while (later + 2 < run_.size() && run_.Newest(later + 1).stamp_ns >= stamp_ns) ++later;
  const StampedPose& a = run_.Newest(later + 1);
  const StampedPose& b = run_.Newest(later);
  if (!GoesOn(a.stamp_ns, b.stamp_ns)) return false;
  const std::uint64_t ahead_ns = SpanNs(b.stamp_ns, stamp_ns);
  if (ahead_ns > static_cast<std::uint64_t>(settings_.max_ahead_ns)) return false;
  if (ahead_ns > 0) AddSaturating(counters_.continued);
  const auto gap = static_cast<double>(SpanNs(a.stamp_ns, b.stamp_ns));
  T_wb = Between(a.T_wb, b.T_wb, static_cast<double>(SpanNs(a.stamp_ns, stamp_ns)) / gap);
  return true;
}

}  // namespace disflow::hal
