// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/ros/ros_depth_decoder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "disflow/hal/little_endian.h"
#include "disflow/host/image_limits.h"
#include "disflow/posix/shown_text.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

/// An enumeration and two floats ahead of the PNG, little endian as all that ROS runs on.
constexpr std::size_t kParameterBytes = 12;

bool FormatOf(std::string_view encoding, DepthFormat& format) noexcept {
  const bool is_float = encoding == "32FC1";
  format = is_float ? DepthFormat::kFloat32 : DepthFormat::kUint16;
  return is_float || encoding == "16UC1";
}

Fault NoDepth(std::string_view encoding) {
  return MakeFault(Status::kUnsupported,
                   "encoding '%s' is no depth; 16UC1 and 32FC1 are: is this the depth topic?",
                   ShownText(encoding).c_str());
}

std::string_view Trimmed(std::string_view text) noexcept {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

void SwapBytes(std::uint8_t* row, std::size_t pixels, std::size_t pixel_bytes) noexcept {
  for (std::size_t i = 0; i < pixels; ++i) {
    std::reverse(row + i * pixel_bytes, row + (i + 1) * pixel_bytes);
  }
}

float FloatAt(std::span<const std::uint8_t> data, std::size_t offset) noexcept {
  return hal::LoadLittleEndian<float>(std::as_bytes(data).subspan(offset));
}

std::uint32_t BigEndianAt(std::span<const std::uint8_t> data, std::size_t offset) noexcept {
  std::uint32_t value = 0;
  for (const std::uint8_t byte : data.subspan(offset, sizeof(value))) value = value << 8U | byte;
  return value;
}

/// `ENCODING; compressedDepth CODEC`; without the codec, as before ROS 2 Jazzy, it is png.
Fault ReadFormat(std::string_view text, DepthFormat& format) {
  const std::size_t end = std::min(text.find(';'), text.size());
  const std::string_view encoding = Trimmed(text.substr(0, end));
  const std::string_view transport = Trimmed(text.substr(std::min(end + 1, text.size())));
  if (!FormatOf(encoding, format)) return NoDepth(encoding);
  if (transport.empty() || transport == "compressedDepth" || transport == "compressedDepth png") {
    return {};
  }
  return MakeFault(Status::kUnsupported,
                   "format '%s' cannot be read; set the publisher's parameter "
                   "<topic>.compressedDepth.format to png",
                   ShownText(text).c_str());
}

/// Of inverse depth, quantised: depth = a / (value - b).
struct Quantisation {
  float a = 0.0F;
  float b = 0.0F;

  [[nodiscard]] float MetresOf(std::uint16_t value) const noexcept {
    const float metres = a / (static_cast<float>(value) - b);
    // Written so that NaN is no data.
    return value != 0 && metres > 0.0F && std::isfinite(metres) ? metres : 0.0F;
  }
};

}  // namespace

Fault RosDepthDecoder::CheckSize(std::uint32_t width_px, std::uint32_t height_px) const noexcept {
  if (width_px == 0 || height_px == 0) {
    return MakeFault(Status::kCorrupt, "an image of %u x %u pixels", width_px, height_px);
  }
  if (width_px > host::kMaxImageSide_px || height_px > host::kMaxImageSide_px ||
      std::uint64_t{width_px} * height_px > host::kMaxImagePixels) {
    return MakeFault(Status::kImageTooLarge,
                     "an image of %u x %u pixels; %u a side and %ju in all can be taken", width_px,
                     height_px, host::kMaxImageSide_px, std::uintmax_t{host::kMaxImagePixels});
  }
  if (width_px_ == 0) return {};
  if (width_px == static_cast<std::uint32_t>(width_px_) &&
      height_px == static_cast<std::uint32_t>(height_px_)) {
    return {};
  }
  return MakeFault(Status::kImageTooLarge,
                   "an image of %u x %u pixels, where the first had %d x %d; for another size "
                   "start disflow_track anew",
                   width_px, height_px, width_px_, height_px_);
}

Fault RosDepthDecoder::Decode(const RosImage& image, DepthView& depth) const noexcept {
  DepthFormat format{};
  if (!FormatOf(image.encoding, format)) return NoDepth(image.encoding);
  if (const Fault fault = CheckSize(image.width_px, image.height_px); !fault.ok()) return fault;
  const std::size_t pixel = format == DepthFormat::kFloat32 ? 4 : 2;
  const std::size_t row = image.width_px * pixel;
  std::size_t step = image.step_bytes;
  if (step < row) {
    return MakeFault(Status::kCorrupt, "step %zu is shorter than %u pixels of %zu bytes", step,
                     image.width_px, pixel);
  }
  // Nobody needs the padding of the last row.
  if (image.height_px == 1) step = row;
  const std::uint64_t bytes = std::uint64_t{image.height_px - 1} * step + row;
  if (image.data.size() < bytes) {
    return MakeFault(Status::kTruncated, "an image of %u x %u pixels with %zu of %ju bytes",
                     image.width_px, image.height_px, image.data.size(), std::uintmax_t{bytes});
  }
  std::uint8_t* const data = image.data.data();
  if (step % pixel != 0) {
    for (std::size_t v = 1; v < image.height_px; ++v) {
      std::memmove(data + v * row, data + v * step, row);
    }
    step = row;
  }
  if (image.is_big_endian != (std::endian::native == std::endian::big)) {
    for (std::size_t v = 0; v < image.height_px; ++v) {
      SwapBytes(data + v * step, image.width_px, pixel);
    }
  }
  depth = {.data = data,
           .width_px = static_cast<int>(image.width_px),
           .height_px = static_cast<int>(image.height_px),
           .stride_bytes = static_cast<std::ptrdiff_t>(step),
           .format = format};
  return {};
}

/// Before libpng unpacks it: the size and that a pixel has 16 bits.
Fault RosDepthDecoder::CheckHeader(std::span<const std::uint8_t> png) const noexcept {
  // Signature, length and name of the first chunk, which libpng insists on being this one.
  constexpr std::size_t kWidth = 16;
  constexpr std::size_t kHeight = 20;
  constexpr std::size_t kBits = 24;
  if (png.size() <= kBits) {
    return MakeFault(Status::kTruncated, "a compressed image of %zu bytes", png.size());
  }
  const Fault fault = CheckSize(BigEndianAt(png, kWidth), BigEndianAt(png, kHeight));
  if (!fault.ok() || png[kBits] == 16) return fault;
  return MakeFault(Status::kCorrupt, "its PNG has %d bits per pixel; 16 are needed", png[kBits]);
}

Fault RosDepthDecoder::DecodeCompressed(std::string_view format, std::span<const std::uint8_t> data,
                                        DepthView& depth) noexcept {
  DepthFormat pixels{};
  if (const Fault fault = ReadFormat(format, pixels); !fault.ok()) return fault;
  const auto png = data.subspan(std::min(kParameterBytes, data.size()));
  Fault fault = CheckHeader(png);
  if (fault.ok()) fault = host::ReadGrayPng(png, "its PNG", picture_);
  if (!fault.ok()) return fault;
  depth = {.data = picture_.pixels.data(),
           .width_px = picture_.width_px,
           .height_px = picture_.height_px,
           .stride_bytes = picture_.width_px * std::ptrdiff_t{2}};
  if (pixels == DepthFormat::kUint16) return {};
  const Quantisation quantisation{FloatAt(data, 4), FloatAt(data, 8)};
  if (!(quantisation.a > 0.0F) || !std::isfinite(quantisation.a) ||
      !std::isfinite(quantisation.b)) {
    return MakeFault(Status::kCorrupt, "parameters %g and %g are no quantisation of inverse depth",
                     static_cast<double>(quantisation.a), static_cast<double>(quantisation.b));
  }
  metres_.resize(picture_.pixels.size());
  std::transform(picture_.pixels.begin(), picture_.pixels.end(), metres_.begin(),
                 [&quantisation](std::uint16_t value) { return quantisation.MetresOf(value); });
  depth.data = metres_.data();
  depth.stride_bytes *= 2;
  depth.format = DepthFormat::kFloat32;
  return {};
}

std::size_t RosDepthDecoder::MostCompressedBytes(int width_px, int height_px) noexcept {
  constexpr std::size_t kChunks = 65536;
  const std::size_t row = 1 + 2 * static_cast<std::size_t>(width_px);
  const std::size_t raw = row * static_cast<std::size_t>(height_px);
  return raw + raw / 64 + kChunks;
}

}  // namespace disflow::posix
