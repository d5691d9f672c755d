// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/depth_metres.h"

#include <cstring>

namespace disflow::host {

void CopyMetres(const DepthView& depth, void* target) noexcept {
  const auto columns = static_cast<std::size_t>(depth.width_px);
  const std::size_t row_bytes = columns * sizeof(float);
  auto* bytes = static_cast<std::byte*>(target);
  for (int v = 0; v < depth.height_px; ++v, bytes += row_bytes) {
    const std::byte* const source = depth.row(v);
    if (depth.format == DepthFormat::kFloat32) {
      std::memcpy(bytes, source, row_bytes);
      continue;
    }
    for (std::size_t u = 0; u < columns; ++u) {
      std::uint16_t raw = 0;
      std::memcpy(&raw, source + sizeof(raw) * u, sizeof(raw));
      const float depth_m = static_cast<float>(raw) * depth.unit_m;
      std::memcpy(bytes + sizeof(depth_m) * u, &depth_m, sizeof(depth_m));
    }
  }
}

}  // namespace disflow::host
