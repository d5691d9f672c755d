// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "disflow/geometry/pinhole_camera.h"
#include "disflow/hal/fault.h"
#include "disflow/posix/camera/depth_pixel_format.h"

namespace disflow::posix {

/// Which camera, and how it is to deliver depth, taken apart. Texts are zero-terminated copies.
struct CameraAddress {
  enum class Kind : std::uint8_t { kV4l2, kLibcamera };

  static constexpr std::size_t kMaxDeviceLength = 255;
  static constexpr std::size_t kMaxSerialLength = 127;  ///< USB allows 126 characters.
  static constexpr std::size_t kMaxFileLength = 1023;
  static constexpr int kMaxSide_px = 8192;
  static constexpr float kMaxRate_hz = 1000.0F;

  Kind kind = Kind::kV4l2;
  /// V4L2: path of the device, empty if it is found by serial. libcamera: number or id.
  char device[kMaxDeviceLength + 1] = {};
  char serial[kMaxSerialLength + 1] = {};    ///< V4L2: of the USB device; empty = by path.
  const DepthPixelFormat* format = nullptr;  ///< Null = the first one that can be used.
  int width_px = 0;                          ///< 0 = as the intrinsics file says, with height_px.
  int height_px = 0;
  float rate_hz = 0.0F;                      ///< 0 = the driver's.
  float unit_m = 0.0F;                       ///< Metres per unit; 0 = not said.
  char intrinsics[kMaxFileLength + 1] = {};  ///< TOML, or YAML of ROS; empty = `camera` holds them.
  bool rectified = false;                    ///< By the driver; tells which matrix of YAML counts.
  PinholeCamera camera;                      ///< Given by K=; not valid if a file is named.
};

/// Reads
/// `v4l2:/dev/NAME?OPTIONS`, `v4l2:serial=TEXT?OPTIONS` (also `v4l2:serial=TEXT&OPTIONS`) or
/// `libcamera:NUMBER?OPTIONS`, `libcamera:ID?OPTIONS`, with OPTIONS separated by '&':
/// format=NAME, width=PX, height=PX, fps=HZ, depth_scale=METRES, intrinsics=FILE or K=fx,fy,cx,cy,
/// rectified=yes|no. Bounded in everything; no heap.
/// @param address Unchanged unless the result is ok.
/// @return kInvalidUri with the part that is wrong and what is allowed.
[[nodiscard]] hal::Fault ParseCameraAddress(std::string_view uri, CameraAddress& address) noexcept;

/// @return true if the address has one of the schemes that ParseCameraAddress() knows.
[[nodiscard]] bool IsCameraAddress(std::string_view uri) noexcept;

/// The schemes and their options, for --help.
extern const char* const kCameraAddressHelp;

}  // namespace disflow::posix
