// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/ros/ros_camera_info.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "disflow/posix/shown_text.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

constexpr std::string_view kCompressedDepth = "/compressedDepth";

/// Models that are a pinhole where all coefficients are 0; a fisheye's never is.
bool IsPinholeModel(std::string_view model) noexcept {
  constexpr std::array<std::string_view, 11> kModels = {
      "",
      "plumb_bob",
      "rational_polynomial",
      "thin_prism",
      "none",
      "brown_conrady",
      "inverse_brown_conrady",
      // As librealsense writes them into its own recordings.
      "None",
      "Brown Conrady",
      "Inverse Brown Conrady",
      "Modified Brown Conrady",
  };
  return std::find(kModels.begin(), kModels.end(), model) != kModels.end();
}

/// Whether the lens moves pixels. Less than this moves none by a hundredth.
bool IsDistorted(const RosCameraInfo& info) noexcept {
  constexpr double kNone = 1e-6;
  // Written so that NaN is.
  const bool any =
      std::any_of(info.d.begin(), info.d.end(), [](double d) { return !(std::abs(d) <= kNone); });
  return any || !IsPinholeModel(info.distortion_model);
}

Fault ReadSize(const RosCameraInfo& info, RosIntrinsics& intrinsics) {
  const bool whole = info.roi_width_px == 0 && info.roi_height_px == 0;
  const std::uint64_t width_px = whole ? info.width_px : info.roi_width_px;
  const std::uint64_t height_px = whole ? info.height_px : info.roi_height_px;
  if (info.roi_x_px + width_px > info.width_px || info.roi_y_px + height_px > info.height_px) {
    return MakeFault(Status::kUnsupported,
                     "its region of interest %u,%u %ju x %ju is not within its %u x %u pixels",
                     info.roi_x_px, info.roi_y_px, std::uintmax_t{width_px},
                     std::uintmax_t{height_px}, info.width_px, info.height_px);
  }
  intrinsics.width_px = static_cast<std::uint32_t>(width_px / std::max(info.binning_x, 1U));
  intrinsics.height_px = static_cast<std::uint32_t>(height_px / std::max(info.binning_y, 1U));
  return {};
}

}  // namespace

Fault ReadCameraInfo(const RosCameraInfo& info, bool rectified,
                     RosIntrinsics& intrinsics) noexcept {
  if (!rectified && IsDistorted(info)) {
    return MakeFault(Status::kUnsupported,
                     "the lens distorts (%s, first coefficient %g) and the images are not "
                     "rectified: subscribe to the rectified topic (image_proc makes one), or say "
                     "rectified=yes if they are",
                     ShownText(info.distortion_model).c_str(), info.d.empty() ? 0.0 : info.d[0]);
  }
  RosIntrinsics read;
  if (const Fault fault = ReadSize(info, read); !fault.ok()) return fault;
  // Without distortion both say the same, and not everybody fills P in.
  const bool by_p = rectified && (info.p[0] != 0.0 || IsDistorted(info));
  // Rows of P have four numbers, those of K three.
  const std::span<const double> m = by_p ? std::span<const double>(info.p) : info.k;
  const std::size_t second = by_p ? 4 : 3;
  if (m[1] != 0.0) {
    return MakeFault(Status::kUnsupported, "its pixels are skewed (%s[1] is %g); they must not be",
                     by_p ? "P" : "K", m[1]);
  }
  const double bin_x = std::max(info.binning_x, 1U);
  const double bin_y = std::max(info.binning_y, 1U);
  read.camera = {static_cast<float>(m[0] / bin_x), static_cast<float>(m[second + 1] / bin_y),
                 static_cast<float>((m[2] - info.roi_x_px) / bin_x),
                 static_cast<float>((m[second + 2] - info.roi_y_px) / bin_y)};
  const auto width = static_cast<int>(std::min(read.width_px, 1U << 20U));
  const auto height = static_cast<int>(std::min(read.height_px, 1U << 20U));
  if (!read.camera.IsValid() || !read.camera.CanImage(width, height)) {
    return MakeFault(Status::kInvalidIntrinsics,
                     "fx %g, fy %g, cx %g, cy %g of its %s are no calibration of %u x %u pixels: "
                     "calibrate the camera",
                     m[0], m[second + 1], m[2], m[second + 2], by_p ? "P" : "K", read.width_px,
                     read.height_px);
  }
  intrinsics = read;
  return {};
}

bool IsCompressedDepthTopic(std::string_view topic) noexcept {
  return topic.ends_with(kCompressedDepth);
}

bool IsRectifiedTopic(std::string_view topic) noexcept {
  if (IsCompressedDepthTopic(topic)) topic.remove_suffix(kCompressedDepth.size());
  const std::size_t slash = topic.rfind('/');
  return topic.find("rect", slash == std::string_view::npos ? 0 : slash) != std::string_view::npos;
}

std::string CameraInfoTopic(std::string_view image_topic) {
  if (IsCompressedDepthTopic(image_topic)) image_topic.remove_suffix(kCompressedDepth.size());
  const std::size_t slash = image_topic.rfind('/');
  return std::string(image_topic.substr(0, slash == std::string_view::npos ? 0 : slash)) +
         "/camera_info";
}

}  // namespace disflow::posix
