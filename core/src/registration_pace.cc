// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/registration_pace.h"

namespace disflow {
namespace {

constexpr int kMinSteps = 5;  // the kernels are narrow then
constexpr int kMinSearches = 2;
constexpr float kNearby_m = 2e-3F;    // a tenth of a cell
constexpr float kNearby_rad = 2e-2F;  // the same at a hand's breadth
constexpr float kSettledScale_m = 0.003F;
constexpr float kSettled_m = 5e-4F;
constexpr float kSettled_rad = 5e-3F;
constexpr float kConverged_m = 1e-5F;
constexpr float kConverged_rad = 1e-4F;
// What slides along a face moves by more than this until it is back in its place.
constexpr float kHardlyMoved_m = 1e-4F;
constexpr float kHardlyMoved_rad = 1e-3F;
constexpr float kNarrower = 0.5F;
constexpr float kMuchNarrower = 0.25F;

bool IsSmallerThan(const Vec6& xi, float bound_m, float bound_rad) noexcept {
  return xi.head<3>().norm() < bound_m && xi.tail<3>().norm() < bound_rad;
}

}  // namespace

void RegistrationPace::Advance(const Vec6& xi, float std_m) noexcept {
  ++steps_;
  matching_ = MatchingAfter(xi);
  done_ = IsDoneAfter(xi, std_m);
  if (done_) return;
  const float share = MayHurry() ? kMuchNarrower : kNarrower;
  scale_ = {share * scale_.surface_m, share * scale_.edges_m};
}

Matching RegistrationPace::MatchingAfter(const Vec6& xi) const noexcept {
  if (steps_ >= kMinSearches && scale_.surface_m < kSettledScale_m &&
      IsSmallerThan(xi, kSettled_m, kSettled_rad)) {
    return Matching::kLinear;
  }
  return IsSmallerThan(xi, kNearby_m, kNearby_rad) ? Matching::kKeep : Matching::kSearch;
}

bool RegistrationPace::IsDoneAfter(const Vec6& xi, float std_m) const noexcept {
  if (steps_ >= limit_.most) return true;
  if (steps_ >= kMinSteps && IsSmallerThan(xi, kConverged_m, kConverged_rad)) return true;
  // A kernel narrower than a residual's own standard deviation is taken for as wide as that.
  return MayHurry() && scale_.surface_m < std_m &&
         IsSmallerThan(xi, kHardlyMoved_m, kHardlyMoved_rad);
}

bool RegistrationPace::MayHurry() const noexcept {
  return limit_.may_end_early && matching_ == Matching::kLinear;
}

}  // namespace disflow
