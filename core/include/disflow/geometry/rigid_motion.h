// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/geometry/transform.h"

namespace disflow {

/// Whether it is finite and its rotation one: neither scaled nor mirrored, to a hundredth.
template <class To, class From, class Scalar>
[[nodiscard]] inline bool IsRigid(const Transform<To, From, Scalar>& T) noexcept {
  constexpr auto kTolerance = Scalar(1e-2);
  using Matrix3 = Mat<Scalar, 3, 3>;
  const Matrix3 gram = T.rotation().transpose() * T.rotation();
  return T.IsFinite() && (gram - Matrix3::Identity()).cwiseAbs().maxCoeff() < kTolerance &&
         T.rotation().determinant() > Scalar(0);
}

}  // namespace disflow
