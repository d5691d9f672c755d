// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/depth_frame.h"

#include "disflow/geometry/rigid_motion.h"

namespace disflow {

bool HasUsablePose(const DepthFrame& frame) noexcept {
  return frame.has_T_wc && IsRigid(frame.T_wc);
}

Status CheckFrame(const DepthFrame& frame, int max_width_px, int max_height_px) noexcept {
  const DepthView& depth = frame.depth;
  if (depth.data == nullptr || depth.width_px <= 0 || depth.height_px <= 0)
    return Status::kInvalidImageSize;
  if (depth.width_px > max_width_px || depth.height_px > max_height_px)
    return Status::kImageTooLarge;
  if (depth.stride_bytes < static_cast<std::ptrdiff_t>(depth.width_px) * depth.bytes_per_pixel()) {
    return Status::kInvalidImageSize;
  }
  if (depth.format == DepthFormat::kUint16 &&
      !(depth.unit_m > 0.0F && std::isfinite(depth.unit_m))) {
    return Status::kInvalidImageSize;
  }
  if (!frame.camera.IsValid() || !frame.camera.CanImage(depth.width_px, depth.height_px))
    return Status::kInvalidIntrinsics;
  if (frame.mask.given() &&
      (frame.mask.width_px != depth.width_px || frame.mask.height_px != depth.height_px ||
       frame.mask.stride_bytes < frame.mask.width_px)) {
    return Status::kMaskSizeMismatch;
  }
  if (frame.has_T_wc && !HasUsablePose(frame)) return Status::kInvalidTransform;
  return Status::kOk;
}

}  // namespace disflow
