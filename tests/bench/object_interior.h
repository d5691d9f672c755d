// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config.h"
#include "disflow/depth/depth_frame.h"

namespace disflow::bench {

/// Whether a pixel is the object's and not at its outline, which the tracker leaves out as well
/// (sampler.border_px): pixels there mix the object's depth with what is behind it. Without a mask
/// every pixel is.
inline bool IsInterior(const MaskView& mask, int u, int v) {
  if (!mask.given()) return true;
  const int border_px = SamplerConfig{}.border_px;
  for (int row = v - border_px; row <= v + border_px; ++row) {
    for (int column = u - border_px; column <= u + border_px; ++column) {
      if (!mask.Test(column, row)) return false;
    }
  }
  return true;
}

}  // namespace disflow::bench
