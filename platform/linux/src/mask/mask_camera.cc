// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/mask_camera.h"

#include <chrono>
#include <cstring>

#include "disflow/saturating.h"

namespace disflow::posix {
namespace {

constexpr std::int64_t kTimeout_ns = 200'000'000;
constexpr std::chrono::milliseconds kBetweenAttempts{500};

/// What a depth sensor needs to know and a mask has not; and the size, which is not negotiable.
CameraAddress AddressOf(CameraAddress address, int width_px, int height_px) {
  address.format = &V4l2MaskFormat();
  address.width_px = width_px;
  address.height_px = height_px;
  address.camera = {1.0F, 1.0F, 0.0F, 0.0F};
  address.unit_m = 1.0F;
  return address;
}

}  // namespace

hal::Fault ParseMaskCamera(const std::string& name, CameraAddress& address) noexcept {
  const hal::Fault fault = ParseCameraAddress(name, address);
  if (!fault.ok()) return fault;
  const bool more_than_rate = address.format != nullptr || address.width_px != 0 ||
                              address.unit_m > 0.0F || address.intrinsics[0] != '\0' ||
                              address.camera.IsValid() || address.rectified;
  if (address.kind == CameraAddress::Kind::kV4l2 && !more_than_rate) return {};
  return hal::MakeFault(Status::kInvalidUri,
                        "mask stream '%s': masks come from v4l2:/dev/NAME or v4l2:serial=TEXT, "
                        "with no option but fps=; format (GREY) and size are given",
                        name.c_str());
}

MaskCamera::MaskCamera(const std::string& name, const CameraAddress& address, int width_px,
                       int height_px, std::int64_t max_age_ns, VideoKernel& kernel,
                       const char* sys_root, const char* dev_root)
    : MaskSource(name, width_px, height_px, max_age_ns),
      sensor_(AddressOf(address, width_px, height_px), {}, kernel, sys_root, dev_root) {
  const auto pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  masks_.ForEach([pixels](Mask& mask) { mask.pixels.resize(pixels); });
  thread_ = std::thread([this] { TakeAll(); });
}

MaskCamera::~MaskCamera() {
  stop_ = true;
  thread_.join();
}

Status MaskCamera::DoNewest(Newest& newest) noexcept {
  has_current_ = masks_.Take() || has_current_;
  // The last good one stands until it is too old, whatever has become of the device.
  newest = {masks_.front().pixels.data(), masks_.front().stamp_ns};
  if (has_current_) return Status::kOk;
  const bool is_wrong = status_ == Status::kUnsupported;
  AddSaturating(is_wrong ? counters_.wrong_size : counters_.missing);
  return is_wrong ? Status::kMaskSizeMismatch : Status::kNotFound;
}

void MaskCamera::TakeAll() noexcept {
  while (!stop_) {
    if (open_) {
      TakeOne();
      continue;
    }
    const hal::Fault fault = sensor_.Open();
    open_ = fault.ok();
    status_.store(fault.status);
    if (!open_) Nap();
  }
  sensor_.Close();
}

void MaskCamera::TakeOne() noexcept {
  DepthFrame frame;
  const hal::Fault fault = sensor_.Next(kTimeout_ns, frame);
  if (fault.status == Status::kDeviceLost || fault.status == Status::kUnsupported) {
    sensor_.Close();
    open_ = false;
    status_.store(fault.status);
  }
  if (!fault.ok()) return;
  // The rows are bytes, whatever the view calls them.
  Mask& mask = masks_.back();
  const auto width = static_cast<std::size_t>(width_px_);
  for (int v = 0; v < height_px_; ++v) {
    std::memcpy(&mask.pixels[static_cast<std::size_t>(v) * width], frame.depth.row(v), width);
  }
  mask.stamp_ns = frame.stamp_ns;
  (void)masks_.Publish();
}

void MaskCamera::Nap() const noexcept {
  const auto until = std::chrono::steady_clock::now() + kBetweenAttempts;
  while (!stop_ && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace disflow::posix
