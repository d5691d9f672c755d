// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/mask_source.h"

#include "disflow/posix/mask_camera.h"
#include "disflow/posix/mask_stream.h"
#include "disflow/saturating.h"

namespace disflow::posix {

Status MaskSource::Attach(DepthFrame& frame) noexcept {
  frame.mask = {};
  Newest newest;
  const Status status = DoNewest(newest);
  if (status != Status::kOk) return status;
  if (frame.depth.width_px != width_px_ || frame.depth.height_px != height_px_) {
    AddSaturating(counters_.wrong_size);
    return Status::kMaskSizeMismatch;
  }
  // Stamps may be anything: compared without overflow.
  std::int64_t apart_ns = 0;
  const bool overflow = __builtin_sub_overflow(frame.stamp_ns, newest.stamp_ns, &apart_ns);
  if (overflow || apart_ns > max_age_ns_ || apart_ns < -max_age_ns_) {
    AddSaturating(counters_.late);
    return Status::kTimeout;
  }
  AddSaturating(counters_.used);
  frame.mask = {newest.data, width_px_, height_px_, width_px_};
  return Status::kOk;
}

hal::Fault CheckMaskName(const std::string& name) noexcept {
  if (IsCameraAddress(name)) {
    CameraAddress address;
    return ParseMaskCamera(name, address);
  }
  if (MaskStream::IsName(name)) return {};
  return hal::MakeFault(Status::kInvalidUri,
                        "mask stream '%s': '/NAME' of a shared memory object, 'file:PATH' or "
                        "'v4l2:DEVICE' is needed, see docs/masks.md",
                        name.c_str());
}

std::unique_ptr<MaskSource> MakeMaskSource(const std::string& name, int width_px, int height_px,
                                           std::int64_t max_age_ns) {
  CameraAddress address;
  if (IsCameraAddress(name) && ParseMaskCamera(name, address).ok()) {
    return std::make_unique<MaskCamera>(name, address, width_px, height_px, max_age_ns);
  }
  return std::make_unique<MaskStream>(name, width_px, height_px, max_age_ns);
}

}  // namespace disflow::posix
