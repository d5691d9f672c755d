// SPDX-License-Identifier: BSD-3-Clause
#include "mask_morphology.h"

#include <cstdlib>

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

void SpreadMask(int reach_px, int width_px, int height_px, std::vector<std::uint8_t>& rows,
                std::vector<std::uint8_t>& mask) {
  // Growing spreads the object, shrinking spreads what is not the object.
  const std::uint8_t wanted = reach_px > 0 ? 255 : 0;
  const int reach = std::abs(reach_px);
  for (int v = 0; v < height_px; ++v)
    Spread(wanted, reach, mask.data() + v * width_px, rows.data() + v * width_px, width_px, 1);
  for (int u = 0; u < width_px; ++u)
    Spread(wanted, reach, rows.data() + u, mask.data() + u, height_px, width_px);
}

}  // namespace disflow::host
