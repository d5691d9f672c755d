// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/first_view.h"

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

Mat6 FirstView::covariance_o() const noexcept {
  Mat6 covariance = noise_.asDiagonal() * registered_o_ * noise_.asDiagonal();
  // Across the first view's rays, which are the third axis of the object frame, the pose hangs on
  // outlines, which err alike whatever their number.
  covariance.diagonal().head<2>().array() += outline_m_ * outline_m_;
  return covariance;
}

}  // namespace disflow
