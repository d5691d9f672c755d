// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/sloppy_mask.h"

#include "mask_morphology.h"

namespace disflow::host {
SloppyMask::SloppyMask(int width_px, int height_px)
    : width_(width_px),
      height_(height_px),
      rows_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
      mask_(rows_.size()) {}

void SloppyMask::Update(int frame, std::span<const std::uint8_t> exact) {
  if (frame / kHeldFrames == period_) return;
  period_ = frame / kHeldFrames;
  mask_.assign(exact.begin(), exact.end());
  SpreadMask(period_ % 2 == 0 ? kReach_px : -kReach_px, width_, height_, rows_, mask_);
}

}  // namespace disflow::host
