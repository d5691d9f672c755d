// SPDX-License-Identifier: BSD-3-Clause
#include "consistency.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace disflow::apps {
namespace {

/// Where the tracker's object frame truly is: it is fixed to the body since the alignment.
EstimatedPose TruePoseOfTrackerFrame(const AlignedTrajectory& run, const AlignedFrame& frame) {
  return frame.T_ct * run.T_ot.Inverse();
}

Vec6d PoseError(const AlignedTrajectory& run, const AlignedFrame& frame) {
  const EstimatedPose truth = TruePoseOfTrackerFrame(run, frame);
  const EstimatedPose& estimate = frame.row->T_co;
  Vec6d error;
  error << estimate.translation() - truth.translation(),
      LogSo3(Mat3d(estimate.rotation() * truth.rotation().transpose()));
  return error;
}

Vec6d TwistError(const AlignedTrajectory& run, const AlignedFrame& frame) {
  const Vec3d origin = TruePoseOfTrackerFrame(run, frame).translation();
  const PointTwist truth = MoveTo(frame.twist, origin - frame.T_ct.translation());
  Vec6d error;
  error << frame.row->twist.linear_mps - truth.linear_mps,
      frame.row->twist.angular_rps - truth.angular_rps;
  return error;
}

double Share(const std::vector<double>& values, std::size_t total, double low, double high) {
  const auto inside =
      std::count_if(values.begin(), values.end(), [&](double x) { return x >= low && x <= high; });
  return static_cast<double>(inside) / static_cast<double>(total);
}

template <class Error>
std::optional<Consistency> OfErrors(const AlignedTrajectory& run,
                                    const std::optional<Mat6d> EstimateRow::*covariance,
                                    Error error_of) {
  Consistency result;
  for (const AlignedFrame& frame : run.frames) {
    result.by_frame.push_back(std::numeric_limits<double>::quiet_NaN());
    const std::optional<Mat6d>& given = frame.row->*covariance;
    if (!given || frame.row->frame == run.aligned_frame) continue;
    const Eigen::LLT<Mat6d> factor(*given);
    if (factor.info() != Eigen::Success) {
      ++result.singular;
      continue;
    }
    const Vec6d error = error_of(run, frame);
    result.nees.push_back(error.dot(factor.solve(error)));
    result.by_frame.back() = result.nees.back();
  }
  const std::size_t total = result.nees.size() + result.singular;
  if (total == 0) return std::nullopt;
  result.statistics = Summarise(result.nees);
  result.share_inside = Share(result.nees, total, kChiSquare6At2_5, kChiSquare6At97_5);
  result.share_below_95 = Share(result.nees, total, 0.0, kChiSquare6At95);
  return result;
}

}  // namespace

double ChiSquare6Cdf(double x) {
  const double half = 0.5 * x;
  return 1.0 - std::exp(-half) * (1.0 + half + 0.5 * half * half);
}

std::optional<Consistency> EvaluatePoseConsistency(const AlignedTrajectory& run) {
  return OfErrors(run, &EstimateRow::pose_covariance, PoseError);
}

std::optional<Consistency> EvaluateTwistConsistency(const AlignedTrajectory& run) {
  return OfErrors(run, &EstimateRow::twist_covariance, TwistError);
}

}  // namespace disflow::apps
