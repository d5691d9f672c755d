// SPDX-License-Identifier: BSD-3-Clause
#include "visibility.h"

#include <cmath>
#include <limits>

#include "disflow/depth/depth_reader.h"

namespace disflow::apps {
namespace {

constexpr std::size_t kFrameStride = 5;

bool Shows(const DepthFrame& frame, const DepthReader& depth, const Vec3d& x_c) {
  if (!(x_c.z() > 0.0)) return false;
  const Vec2 pixel = frame.camera.Project(x_c.cast<float>());
  const bool inside = pixel.x() > -0.5F && pixel.y() > -0.5F &&
                      pixel.x() < static_cast<float>(depth.width_px()) &&
                      pixel.y() < static_cast<float>(depth.height_px());
  if (!inside) return false;  // also guards the conversion to int
  const float depth_m = depth.AtOrZero(static_cast<int>(std::lround(pixel.x())),
                                       static_cast<int>(std::lround(pixel.y())));
  return depth_m > 0.0F && std::abs(static_cast<double>(depth_m) - x_c.z()) < kSeenTolerance_m;
}

}  // namespace

void MarkSeen(const DepthFrame& frame, const TruePose& T_ct,
              const std::vector<SurfacePoint>& points, std::vector<bool>& seen) {
  const DepthReader depth(frame.depth, 0.0F, std::numeric_limits<float>::max());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (seen[i]) continue;
    const Vec3d x_c = T_ct * points[i].position;
    // Zero for an unknown normal, so that such a point is judged by depth alone.
    const double towards_camera = (T_ct.rotation() * points[i].normal).dot(x_c);
    if (towards_camera <= 0.0 && Shows(frame, depth, x_c)) seen[i] = true;
  }
}

std::vector<bool> FindSeen(const Sequence& sequence, const std::vector<SurfacePoint>& points) {
  if (!sequence.image) return {};
  std::vector<bool> seen(points.size(), false);
  bool any_image = false;
  for (std::size_t k = 0; k < sequence.truth.T_ct.size(); k += kFrameStride) {
    const std::optional<DepthFrame> frame = sequence.image(k);
    if (!frame) continue;
    any_image = true;
    MarkSeen(*frame, sequence.truth.T_ct[k], points, seen);
  }
  if (!any_image) return {};
  return seen;
}

}  // namespace disflow::apps
