// SPDX-License-Identifier: BSD-3-Clause
#include "camera_choice.h"

#include "disflow/posix/camera/camera_model.h"

namespace disflow::posix {

using hal::Fault;
using hal::MakeFault;

Fault ChooseIntrinsics(const CameraAddress& address, const CameraDescription& description,
                       CameraDescription& chosen) noexcept {
  chosen = description;
  if (address.camera.IsValid()) chosen.camera = address.camera;
  if (!chosen.camera.IsValid()) {
    return MakeFault(Status::kInvalidIntrinsics,
                     "the camera's intrinsics are needed: intrinsics=FILE.toml or K=fx,fy,cx,cy");
  }
  if (address.width_px == 0) return {};
  const bool agree =
      address.width_px == description.width_px && address.height_px == description.height_px;
  if (description.width_px != 0 && !agree) {
    return MakeFault(Status::kInvalidIntrinsics,
                     "the intrinsics of %s are of %dx%d images, but %dx%d are asked for",
                     address.intrinsics, description.width_px, description.height_px,
                     address.width_px, address.height_px);
  }
  chosen.width_px = address.width_px;
  chosen.height_px = address.height_px;
  return {};
}

Fault ChooseUnit(const CameraAddress& address, const CameraDescription& description,
                 const DepthPixelFormat& format, const VideoNode& node, float& unit_m) noexcept {
  unit_m = address.unit_m > 0.0F ? address.unit_m : description.unit_m;
  if (unit_m > 0.0F) return {};
  const CameraModel* const model =
      node.is_usb ? FindCameraModel(node.vendor_id, node.product_id) : nullptr;
  if (model != nullptr && format.has_metric_unit) {
    unit_m = model->unit_m;
    return {};
  }
  return MakeFault(Status::kUnsupported,
                   "%s: the unit of its depth (%s, USB %04x:%04x) is not known; look it up and say "
                   "depth_scale=0.001 or the like",
                   node.path.c_str(), format.name, unsigned{node.vendor_id},
                   unsigned{node.product_id});
}

}  // namespace disflow::posix
