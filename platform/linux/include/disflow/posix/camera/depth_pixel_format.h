// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace disflow::posix {

/// How a driver lays out the 16-bit depth image in its buffer.
struct DepthPixelFormat {
  /// What has to be done to make it the core's: host-endian 16-bit pixels.
  enum class Conversion : std::uint8_t {
    kNone,       ///< Used where it lies.
    kSwapBytes,  ///< Big-endian.
    kUnpack12,   ///< MIPI CSI-2 RAW12: two pixels in three bytes.
    kUnpack10,   ///< MIPI CSI-2 RAW10: four pixels in five bytes.
  };

  const char* name;            ///< As in an address.
  std::uint32_t fourcc;        ///< V4L2's, or DRM's for libcamera.
  bool is_libcamera;           ///< Belongs to libcamera: addresses.
  bool has_metric_unit;        ///< Made for depth: a known model's unit applies.
  std::uint8_t planes_before;  ///< Images of the same size ahead of the depth image.
  Conversion conversion;
  std::uint8_t bytes_per_pixel = 2;  ///< Of formats that are not packed.
};

/// Formats of `v4l2:` in the order in which they are preferred.
[[nodiscard]] std::span<const DepthPixelFormat> V4l2DepthFormats() noexcept;
/// Formats of `libcamera:` in the order in which they are preferred.
[[nodiscard]] std::span<const DepthPixelFormat> LibcameraDepthFormats() noexcept;

/// Masks, see MaskCamera: 8 bits a pixel. In none of the lists above.
[[nodiscard]] const DepthPixelFormat& V4l2MaskFormat() noexcept;

/// @return The format of that name, or null.
[[nodiscard]] const DepthPixelFormat* FindFormat(std::span<const DepthPixelFormat> formats,
                                                 std::string_view name) noexcept;
/// @return The format of that code, or null.
[[nodiscard]] const DepthPixelFormat* FindFormat(std::span<const DepthPixelFormat> formats,
                                                 std::uint32_t fourcc) noexcept;

/// Bytes that a row of pixels takes at least.
[[nodiscard]] std::size_t MinRowBytes(const DepthPixelFormat& format, int width_px) noexcept;

/// Writes a row of host-endian pixels.
/// @param row At least MinRowBytes(format, pixels.size()) bytes.
void ConvertRow(const DepthPixelFormat& format, const std::byte* row,
                std::span<std::uint16_t> pixels) noexcept;

/// "Z16 " and the like: four letters, anything unprintable as '?', big-endian marked by "-BE".
struct FourccText {
  explicit FourccText(std::uint32_t fourcc) noexcept;
  std::array<char, 8> text{};
};

}  // namespace disflow::posix
