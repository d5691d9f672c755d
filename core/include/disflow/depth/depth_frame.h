// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "disflow/geometry/pinhole_camera.h"
#include "disflow/geometry/transform.h"
#include "disflow/status.h"
#include "disflow/types.h"

/// @file
/// What a depth sensor hands to the tracker. Nothing here owns pixels: the views must stay valid
/// during Process().

namespace disflow {

enum class DepthFormat : std::uint8_t {
  kUint16,   ///< Raw units, see DepthView::unit_m; 0 = no data.
  kFloat32,  ///< Metres; 0, negative, NaN and infinity = no data.
};

/// Non-owning view of a depth image, row-major, first row on top.
struct DepthView {
  const void* data = nullptr;
  int width_px = 0;
  int height_px = 0;
  std::ptrdiff_t stride_bytes =
      0;  ///< From one row's start to the next's; >= width * bytes per pixel.
  DepthFormat format = DepthFormat::kUint16;
  float unit_m = 0.001F;  ///< Metres per unit of kUint16; unused for kFloat32.

  [[nodiscard]] int bytes_per_pixel() const noexcept {
    return format == DepthFormat::kUint16 ? 2 : 4;
  }
  [[nodiscard]] const std::byte* row(int v) const noexcept {
    return static_cast<const std::byte*>(data) + static_cast<std::ptrdiff_t>(v) * stride_bytes;
  }
};

/// Non-owning view of an 8-bit mask. No data pointer = no mask given.
struct MaskView {
  const std::uint8_t* data = nullptr;
  int width_px = 0;
  int height_px = 0;
  std::ptrdiff_t stride_bytes = 0;
  /// Which pixels are the object: those of this value; 0 = all that are not 0. One mask can so show
  /// several objects. A label without data says that the object has a mask, but not with this
  /// frame: its known surface is tracked on, but nothing is taken for it before it was seen.
  std::uint8_t label = 0;

  [[nodiscard]] bool given() const noexcept { return data != nullptr; }
  [[nodiscard]] const std::uint8_t* row(int v) const noexcept {
    return data + static_cast<std::ptrdiff_t>(v) * stride_bytes;
  }
  /// The pixels [u_begin, u_begin + count) of row v that show the object as bits, the first one
  /// lowest. @pre given()
  /// @param count At most 32.
  [[nodiscard]] std::uint32_t BitsIn(int v, int u_begin, int count) const noexcept {
    std::uint32_t bits = 0;
    if (v < 0 || v >= height_px) return bits;
    const std::uint8_t* const pixels = row(v);
    const int end = u_begin + count < width_px ? u_begin + count : width_px;
    for (int u = u_begin > 0 ? u_begin : 0; u < end; ++u) {
      const bool shown = label == 0 ? pixels[u] != 0 : pixels[u] == label;
      bits |= static_cast<std::uint32_t>(shown) << static_cast<unsigned>(u - u_begin);
    }
    return bits;
  }
  /// Whether a pixel shows the object; none outside the image does. @pre given()
  [[nodiscard]] bool Test(int u, int v) const noexcept {
    // Negative ones become large.
    if (static_cast<unsigned>(u) >= static_cast<unsigned>(width_px) ||
        static_cast<unsigned>(v) >= static_cast<unsigned>(height_px))
      return false;
    return label == 0 ? row(v)[u] != 0 : row(v)[u] == label;
  }
};

/// One depth image with all that is known about it.
struct DepthFrame {
  DepthView depth;
  PinholeCamera camera;
  StampNs stamp_ns = 0;  ///< Capture time on a monotonic clock, never the time of arrival.
  MaskView mask;         ///< Optional.
  bool has_T_wc = false;
  Transform<World, Camera> T_wc;  ///< Optional camera pose in the world, valid if has_T_wc.
};

/// Whether the frame says where its camera is, by a rigid-body motion.
[[nodiscard]] bool HasUsablePose(const DepthFrame& frame) noexcept;

/// Checks sizes, strides, intrinsics and T_wc. Pixels are judged later, one by one.
[[nodiscard]] Status CheckFrame(const DepthFrame& frame, int max_width_px,
                                int max_height_px) noexcept;

}  // namespace disflow
