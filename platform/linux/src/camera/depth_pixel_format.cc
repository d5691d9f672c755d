// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/camera/depth_pixel_format.h"

#include <linux/videodev2.h>

#include <bit>
#include <cstring>

namespace disflow::posix {
namespace {

using Conversion = DepthPixelFormat::Conversion;

static_assert(std::endian::native == std::endian::little,
              "Z16, Y16 and Y12 are little-endian and used where they lie");

constexpr std::uint32_t kBigEndian = 1U << 31U;  // as in videodev2.h

constexpr std::array kV4l2{
    DepthPixelFormat{"Z16", V4L2_PIX_FMT_Z16, false, true, 0, Conversion::kNone},
    DepthPixelFormat{"INZI", V4L2_PIX_FMT_INZI, false, true, 1, Conversion::kNone},
    DepthPixelFormat{"Y16", V4L2_PIX_FMT_Y16, false, false, 0, Conversion::kNone},
    DepthPixelFormat{"Y16_BE", V4L2_PIX_FMT_Y16_BE, false, false, 0, Conversion::kSwapBytes},
    DepthPixelFormat{"Y12", V4L2_PIX_FMT_Y12, false, false, 0, Conversion::kNone},
};

// drm_fourcc.h has no names for the packed ones without a modifier; libcamera tells them apart by
// it, so the code here is only a key of this table.
constexpr std::array kLibcamera{
    DepthPixelFormat{"R16", v4l2_fourcc('R', '1', '6', ' '), true, false, 0, Conversion::kNone},
    DepthPixelFormat{"R12", v4l2_fourcc('R', '1', '2', ' '), true, false, 0, Conversion::kNone},
    DepthPixelFormat{"R10", v4l2_fourcc('R', '1', '0', ' '), true, false, 0, Conversion::kNone},
    DepthPixelFormat{"R12_CSI2P", v4l2_fourcc('R', '1', '2', 'P'), true, false, 0,
                     Conversion::kUnpack12},
    DepthPixelFormat{"R10_CSI2P", v4l2_fourcc('R', '1', '0', 'P'), true, false, 0,
                     Conversion::kUnpack10},
};

constexpr DepthPixelFormat kMask{"GREY", V4L2_PIX_FMT_GREY, false, false, 0, Conversion::kNone, 1};

unsigned Byte(const std::byte* bytes, std::size_t i) noexcept {
  return std::to_integer<unsigned>(bytes[i]);
}

void SwapBytes(const std::byte* row, std::span<std::uint16_t> pixels) noexcept {
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    pixels[i] = static_cast<std::uint16_t>((Byte(row, 2 * i) << 8U) | Byte(row, 2 * i + 1));
  }
}

/// The upper 8 bits of `kGroup` pixels, then a byte or so with their lower bits.
template <std::size_t kGroup, unsigned kLowBits>
void Unpack(const std::byte* row, std::span<std::uint16_t> pixels) noexcept {
  constexpr unsigned kLowMask = (1U << kLowBits) - 1U;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t start = i / kGroup * (kGroup + 1);
    const std::size_t in_group = i % kGroup;
    const unsigned low = Byte(row, start + kGroup) >> (kLowBits * in_group) & kLowMask;
    pixels[i] = static_cast<std::uint16_t>(Byte(row, start + in_group) << kLowBits | low);
  }
}

}  // namespace

std::span<const DepthPixelFormat> V4l2DepthFormats() noexcept { return kV4l2; }
std::span<const DepthPixelFormat> LibcameraDepthFormats() noexcept { return kLibcamera; }

const DepthPixelFormat& V4l2MaskFormat() noexcept { return kMask; }

const DepthPixelFormat* FindFormat(std::span<const DepthPixelFormat> formats,
                                   std::string_view name) noexcept {
  for (const DepthPixelFormat& format : formats) {
    if (name == format.name) return &format;
  }
  return nullptr;
}

const DepthPixelFormat* FindFormat(std::span<const DepthPixelFormat> formats,
                                   std::uint32_t fourcc) noexcept {
  for (const DepthPixelFormat& format : formats) {
    if (fourcc == format.fourcc) return &format;
  }
  return nullptr;
}

std::size_t MinRowBytes(const DepthPixelFormat& format, int width_px) noexcept {
  const auto width = static_cast<std::size_t>(width_px);
  switch (format.conversion) {
    case Conversion::kUnpack12:
      return (width + 1) / 2 * 3;
    case Conversion::kUnpack10:
      return (width + 3) / 4 * 5;
    case Conversion::kNone:
    case Conversion::kSwapBytes:
      break;
  }
  return format.bytes_per_pixel * width;
}

void ConvertRow(const DepthPixelFormat& format, const std::byte* row,
                std::span<std::uint16_t> pixels) noexcept {
  switch (format.conversion) {
    case Conversion::kNone:
      std::memcpy(pixels.data(), row, pixels.size_bytes());
      return;
    case Conversion::kSwapBytes:
      return SwapBytes(row, pixels);
    case Conversion::kUnpack12:
      return Unpack<2, 4>(row, pixels);
    case Conversion::kUnpack10:
      return Unpack<4, 2>(row, pixels);
  }
}

FourccText::FourccText(std::uint32_t fourcc) noexcept {
  for (std::size_t i = 0; i < 4; ++i) {
    const auto letter = static_cast<char>(fourcc >> (8 * i) & 0x7FU);
    text[i] = letter >= ' ' && letter <= '~' ? letter : '?';
  }
  if ((fourcc & kBigEndian) != 0) std::memcpy(text.data() + 4, "-BE", 4);
}

}  // namespace disflow::posix
