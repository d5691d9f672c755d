// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/first_view.h"

#include <algorithm>

namespace disflow {

void FirstView::Learn(const Mat6& registered_o, const PoseNoise& noise, float outline_m) noexcept {
  // In which samples of the model average most of their noise away, and poses show theirs.
  constexpr int kFrames = 15;
  if (frames_ == kFrames) return;
  // By what a view that is as good as the first is off against it.
  if (frames_ == 0) registered_o_ = registered_o;
  ++frames_;
  // One frame tells it to a factor of two.
  outline_m_ += (outline_m - outline_m_) / static_cast<float>(frames_);
  noise_ = noise.Of(Mat6::Identity()).diagonal().cwiseSqrt();
}

Mat6 FirstView::Covariance(const Mat3& R_co, float outline_m) const noexcept {
  if (frames_ == 0) return Mat6::Zero();
  Mat6 covariance = noise_.asDiagonal() * registered_o_ * noise_.asDiagonal();
  // Across its rays each view's pose hangs on outlines, which err alike whatever their number. Of
  // what they are off by in both views the pose has the difference.
  const float alike = std::clamp(0.5F * (R_co.trace() - 1.0F), 0.0F, 1.0F);
  const float change_m = outline_m - outline_m_;
  const Mat3 across_first = Vec3(1.0F, 1.0F, 0.0F).asDiagonal();
  const Mat3 across_this = R_co.transpose() * across_first * R_co;
  covariance.topLeftCorner<3, 3>() += (1.0F - alike) * (outline_m_ * outline_m_ * across_first +
                                                        outline_m * outline_m * across_this) +
                                      alike * change_m * change_m * across_first;
  return covariance;
}

}  // namespace disflow
