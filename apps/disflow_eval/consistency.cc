// SPDX-License-Identifier: BSD-3-Clause
#include "consistency.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "disflow/geometry/covariance.h"

namespace disflow::apps {
namespace {

/// Where the tracker's object frame truly is: it is fixed to the body since the alignment.
EstimatedPose TruePoseOfTrackerFrame(const AlignedTrajectory& run, const AlignedFrame& frame) {
  return frame.T_ct * run.T_ot.Inverse();
}

/// From the true origin to the tracker's own, camera axes.
Vec3d Lever(const AlignedTrajectory& run, const AlignedFrame& frame) {
  return TruePoseOfTrackerFrame(run, frame).translation() - frame.T_ct.translation();
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
  const PointTwist truth = MoveTo(frame.twist, Lever(run, frame));
  Vec6d error;
  error << frame.row->twist.linear_mps - truth.linear_mps,
      frame.row->twist.angular_rps - truth.angular_rps;
  return error;
}

/// Covariance that independent errors of (a point, rotation), or of their rates, at the true origin
/// have at the tracker's own.
Mat6d TruthCovariance(const AlignedTrajectory& run, const AlignedFrame& frame, double point_std,
                      double angle_std) {
  Vec6d variances;
  variances << Vec3d::Constant(point_std * point_std), Vec3d::Constant(angle_std * angle_std);
  const Mat6 at_true_origin = variances.cast<float>().asDiagonal();
  return CovarianceAtPoint(at_true_origin, Mat3::Identity(), Lever(run, frame).cast<float>())
      .cast<double>();
}

double Share(const std::vector<double>& values, std::size_t total, double low, double high) {
  const auto inside =
      std::count_if(values.begin(), values.end(), [&](double x) { return x >= low && x <= high; });
  return static_cast<double>(inside) / static_cast<double>(total);
}

template <class Error, class Covariance>
std::optional<Consistency> OfErrors(const AlignedTrajectory& run,
                                    const std::optional<Mat6d> EstimateRow::*covariance,
                                    Error error_of, Covariance truth_covariance) {
  Consistency result;
  for (const AlignedFrame& frame : run.frames) {
    result.by_frame.push_back(std::numeric_limits<double>::quiet_NaN());
    const std::optional<Mat6d>& given = frame.row->*covariance;
    if (!given || frame.row->frame == run.aligned_frame) continue;
    // What is stated has to be a covariance without the help of the truth's.
    if (Eigen::LLT<Mat6d>(*given).info() != Eigen::Success) {
      ++result.singular;
      continue;
    }
    const Eigen::LLT<Mat6d> factor(*given + truth_covariance(frame));
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

std::optional<Consistency> EvaluatePoseConsistency(const AlignedTrajectory& run,
                                                   const TruthDeviation& truth) {
  // Twice: the aligned frame's error, seen from here, has the same covariance as this frame's own,
  // for both are alike in all directions and the lever turns with the object.
  const auto covariance = [&](const AlignedFrame& frame) -> Mat6d {
    return 2.0 * TruthCovariance(run, frame, truth.position_m, truth.rotation_rad);
  };
  return OfErrors(run, &EstimateRow::pose_covariance, PoseError, covariance);
}

std::optional<Consistency> EvaluateTwistConsistency(const AlignedTrajectory& run,
                                                    const TruthDeviation& truth) {
  const auto covariance = [&](const AlignedFrame& frame) -> Mat6d {
    return TruthCovariance(run, frame, truth.linear_mps, truth.angular_rps);
  };
  return OfErrors(run, &EstimateRow::twist_covariance, TwistError, covariance);
}

}  // namespace disflow::apps
