// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/kernel_width.h"

#include <algorithm>

namespace disflow {

void KernelWidth::Learn(float spread) noexcept {
  // Of normal noise, Geman and McClure's kernel of 1 and 2 standard deviations leaves 44 and 78 %
  // of what it tells. 3 would leave 91 %, and lets in more that is none.
  constexpr float kSpreads = 2.0F;
  // Per frame: the spread is that of one object before one camera.
  constexpr float kRate = 0.1F;
  // Of a pose that is off for one frame, residuals tell nothing.
  constexpr float kMostDeviations = 2.0F;
  if (!(spread > 0.0F)) return;
  const float seen = std::min(spread, kMostDeviations);
  spread_ = spread_ > 0.0F ? spread_ + kRate * (seen - spread_) : seen;
  // What spreads by more than is known of noise is the model's or the mask's error: the more of it,
  // the less noise is all there is, and the kernel narrows again.
  factor_ = std::max(kSpreads * std::min(spread_, 1.0F / spread_), 1.0F);
}

}  // namespace disflow
