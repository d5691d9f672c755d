// SPDX-License-Identifier: BSD-3-Clause
#include "flow_cloud.h"

#include <cstdio>

#include "colour_map.h"
#include "ply_bytes.h"

namespace disflow::apps {

std::string FlowCloud::FormatPly(const Estimate& estimate) const {
  char header[768];
  (void)std::snprintf(header, sizeof(header),
                      "ply\nformat binary_little_endian 1.0\n"
                      "comment camera frame, metres, seconds; captured at %.9f s; status %s\n"
                      "comment colours: speed from 0 (dark) to %.9g m/s (bright)\n"
                      "element vertex %zu\n"
                      "property float x\nproperty float y\nproperty float z\n"
                      "property float nx\nproperty float ny\nproperty float nz\n"
                      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                      "property float distance_m\n"
                      "property float gx\nproperty float gy\nproperty float gz\n"
                      "property float vx\nproperty float vy\nproperty float vz\nend_header\n",
                      static_cast<double>(estimate.stamp_ns) * 1e-9, Describe(estimate.status),
                      static_cast<double>(kBrightest_mps), samples_.size());
  std::string ply = header;
  for (const FlowSample& sample : samples_) {
    AppendBytes(sample.position_m, ply);
    AppendBytes(sample.normal, ply);
    AppendBytes(MapColour(sample.flow_mps.norm() / kBrightest_mps), ply);
    AppendBytes(sample.distance_m, ply);
    AppendBytes(sample.gradient, ply);
    AppendBytes(sample.flow_mps, ply);
  }
  return ply;
}

}  // namespace disflow::apps
