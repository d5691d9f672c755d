// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <span>

#include "disflow/field/gp_workspace.h"

/// @file
/// The Gaussian process of section IV as it stands in the paper: dense, in double precision, in
/// metres, without any of the library's scaling. What LocalGp is measured against.

namespace disflow::testing {

using Vec3d = Mat<double, 3>;
using Vec4d = Mat<double, 4>;
using Mat4d = Mat<double, 4, 4>;

class DenseGp {
 public:
  DenseGp(std::span<const GpTrainingSample> samples, const Vec3& center_m, const Vec3& mean_normal,
          const GpHyperparameters& hyper)
      : samples_(samples),
        center_m_(center_m.cast<double>()),
        mean_normal_(mean_normal.cast<double>()),
        length_scale_m_(static_cast<double>(hyper.length_scale_m)),
        gradient_std_(static_cast<double>(hyper.prior_gradient_std)) {
    const auto rows = static_cast<Eigen::Index>(4 * samples.size());
    Eigen::MatrixXd k(rows, rows);
    Eigen::VectorXd y(rows);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(4 * i);
      for (std::size_t j = 0; j < samples.size(); ++j)
        k.block<4, 4>(row, static_cast<Eigen::Index>(4 * j)) = Prior(Position(i), Position(j));
      k.block<4, 4>(row, row).diagonal() += Noise(samples[i]);
      y(row) = -mean_normal_.dot(Position(i) - center_m_);
      y.segment<3>(row + 1) = samples[i].normal.cast<double>() - mean_normal_;
    }
    solver_.compute(k);
    weights_ = solver_.solve(y);
  }

  /// Prior covariance of (d, grad d) at x with the same at x2.
  [[nodiscard]] Mat4d Prior(const Vec3d& x, const Vec3d& x2) const {
    const Vec3d e = x - x2;
    const double distance_m = e.norm();
    const double s = std::sqrt(3.0) / length_scale_m_;
    const double gradient_variance = gradient_std_ * gradient_std_ * std::exp(-s * distance_m);
    Mat4d k;
    k(0, 0) = gradient_variance / (s * s) * (1.0 + s * distance_m);
    k.block<1, 3>(0, 1) = gradient_variance * e.transpose();
    k.block<3, 1>(1, 0) = -gradient_variance * e;
    k.block<3, 3>(1, 1) = gradient_variance * Mat<double, 3, 3>::Identity();
    if (distance_m > 0.0)
      k.block<3, 3>(1, 1) -= gradient_variance * s / distance_m * e * e.transpose();
    return k;
  }

  /// Measurement noise of one sample's (d, grad d).
  [[nodiscard]] static Vec4d Noise(const GpTrainingSample& sample) {
    const auto normal = static_cast<double>(sample.normal_variance);
    return {static_cast<double>(sample.value_variance_m2), normal, normal, normal};
  }

  /// (d, grad d) at x.
  [[nodiscard]] Vec4d Mean(const Vec3d& x) const {
    Vec4d mean;
    mean << mean_normal_.dot(x - center_m_), mean_normal_;
    return mean + Cross(x).transpose() * weights_;
  }

  [[nodiscard]] Mat4d Covariance(const Vec3d& x) const {
    const Eigen::MatrixXd cross = Cross(x);
    return Prior(x, x) - cross.transpose() * solver_.solve(cross);
  }

 private:
  [[nodiscard]] Vec3d Position(std::size_t i) const {
    return samples_[i].position_m.cast<double>();
  }

  /// Covariance of all constraints with (d, grad d) at x.
  [[nodiscard]] Eigen::MatrixXd Cross(const Vec3d& x) const {
    Eigen::MatrixXd cross(weights_.size(), 4);
    for (std::size_t i = 0; i < samples_.size(); ++i)
      cross.block<4, 4>(static_cast<Eigen::Index>(4 * i), 0) = Prior(Position(i), x);
    return cross;
  }

  std::span<const GpTrainingSample> samples_;
  Vec3d center_m_;
  Vec3d mean_normal_;
  double length_scale_m_;
  double gradient_std_;
  Eigen::LDLT<Eigen::MatrixXd> solver_;
  Eigen::VectorXd weights_;
};

}  // namespace disflow::testing
