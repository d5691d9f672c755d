// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "disflow/geometry/transform.h"
#include "disflow/types.h"

namespace disflow {

/// How an object that was out of sight is turned by what was known of its motion. Most things look
/// alike from opposite sides, and then nothing else tells which is seen. An addition to the paper.
class ExpectedTurn {
 public:
  ExpectedTurn() = default;
  /// @param R_oc As predicted.
  /// @param covariance_rad2 Of the turn from there, of any axes.
  ExpectedTurn(const Mat3& R_oc, const Mat3& covariance_rad2) noexcept
      : R_oc_(R_oc), variance_rad2_(std::max(covariance_rad2.trace() / 3.0F, kLeast_rad2)) {}

  /// The negative logarithm of how likely a rotation is beside the expected one [nat].
  [[nodiscard]] float Unlikelihood(const Mat3& R_oc) const noexcept {
    return 0.5F * TurnBetween(R_oc_, R_oc).squaredNorm() / variance_rad2_;
  }

 private:
  /// (0.2 rad)^2: where registration is lost it was off before.
  static constexpr float kLeast_rad2 = 0.04F;

  Mat3 R_oc_ = Mat3::Identity();
  float variance_rad2_ = kLeast_rad2;
};

}  // namespace disflow
