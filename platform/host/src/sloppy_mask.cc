// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/sloppy_mask.h"

#include <algorithm>

namespace disflow::host {
namespace {

/// out[i] = `wanted` if any of the values within reach is `wanted`, else in[i]; along one line.
void Spread(std::uint8_t wanted, int reach, const std::uint8_t* in, std::uint8_t* out, int count,
            int stride) {
  int last_seen = -reach - 1;
  for (int i = 0; i < count + reach; ++i) {
    if (i < count && in[i * stride] == wanted) last_seen = i;
    const int target = i - reach;
    if (target < 0) continue;
    out[target * stride] = last_seen >= target - reach ? wanted : in[target * stride];
  }
}

}  // namespace

SloppyMask::SloppyMask(int width_px, int height_px)
    : width_(width_px),
      height_(height_px),
      rows_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
      mask_(rows_.size()) {}

void SloppyMask::Update(int frame, std::span<const std::uint8_t> exact) {
  if (frame / kHeldFrames == period_) return;
  period_ = frame / kHeldFrames;
  // Growing spreads the object, shrinking spreads what is not the object.
  const std::uint8_t wanted = period_ % 2 == 0 ? 255 : 0;
  for (int v = 0; v < height_; ++v) {
    Spread(wanted, kReach_px, exact.data() + v * width_, rows_.data() + v * width_, width_, 1);
  }
  for (int u = 0; u < width_; ++u) {
    Spread(wanted, kReach_px, rows_.data() + u, mask_.data() + u, height_, width_);
  }
}

}  // namespace disflow::host
