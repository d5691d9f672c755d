// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/png_file.h"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace disflow::host {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { (void)std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

constexpr png_uint_32 kLargestEdge_px = 16384;

// libpng reports through these; exceptions unwind its C frames on every platform that this runs on.
[[noreturn]] void Throw(png_structp, png_const_charp message) { throw std::runtime_error(message); }
void Ignore(png_structp, png_const_charp) {}

/// Owns libpng's two objects for reading.
class Reader {
 public:
  Reader() : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, Throw, Ignore)) {
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) throw std::runtime_error("out of memory");
  }
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void Read(std::FILE* file, GreyImage& image) {
    png_init_io(png_, file);
    png_set_user_limits(png_, kLargestEdge_px, kLargestEdge_px);
    png_read_info(png_, info_);
    if (png_get_color_type(png_, info_) != PNG_COLOR_TYPE_GRAY)
      throw std::invalid_argument("not a grey image");
    if (png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE)
      throw std::invalid_argument("interlaced");
    image.bits = png_get_bit_depth(png_, info_) == 16 ? 16 : 8;
    // PNG is big-endian; pixels below 8 bits are spread to one byte each.
    if (image.bits == 16) png_set_swap(png_);
    if (png_get_bit_depth(png_, info_) < 8) png_set_expand_gray_1_2_4_to_8(png_);
    png_read_update_info(png_, info_);
    image.width_px = static_cast<int>(png_get_image_width(png_, info_));
    image.height_px = static_cast<int>(png_get_image_height(png_, info_));
    const auto width = static_cast<std::size_t>(image.width_px);
    image.pixels.resize(width * static_cast<std::size_t>(image.height_px));
    for (std::size_t v = 0; v < static_cast<std::size_t>(image.height_px); ++v) {
      std::uint16_t* row = &image.pixels[v * width];
      png_read_row(png_, reinterpret_cast<png_bytep>(row), nullptr);
      if (image.bits == 8) Widen(row, width);
    }
  }

 private:
  /// Bytes at the start of a row to 16-bit values, in place from the end.
  static void Widen(std::uint16_t* row, std::size_t width) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(row);
    for (std::size_t i = width; i-- > 0;) row[i] = bytes[i];
  }

  png_structp png_;
  png_infop info_ = nullptr;
};

class Writer {
 public:
  Writer() : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, Throw, Ignore)) {
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) throw std::runtime_error("out of memory");
  }
  ~Writer() { png_destroy_write_struct(&png_, &info_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void Write(std::FILE* file, int width, int height, int channels,
             std::span<const std::uint8_t> pixels) {
    png_init_io(png_, file);
    png_set_compression_level(png_, 1);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8,
                 channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png_, info_);
    const auto stride = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
    for (std::size_t v = 0; v < static_cast<std::size_t>(height); ++v)
      png_write_row(png_, &pixels[v * stride]);
    png_write_end(png_, nullptr);
  }

 private:
  png_structp png_;
  png_infop info_ = nullptr;
};

}  // namespace

hal::Fault ReadPng(const std::string& file, GreyImage& image) {
  const File handle(std::fopen(file.c_str(), "rb"));
  if (!handle)
    return hal::MakeFault(Status::kNotFound, "%s: %s", file.c_str(), std::strerror(errno));
  unsigned char signature[8] = {};
  const std::size_t got = std::fread(signature, 1, sizeof signature, handle.get());
  if (got < sizeof signature)
    return hal::MakeFault(Status::kTruncated, "%s: too short for a PNG file", file.c_str());
  if (png_sig_cmp(signature, 0, sizeof signature) != 0) {
    return hal::MakeFault(Status::kUnsupported, "%s: not a PNG file", file.c_str());
  }
  std::rewind(handle.get());
  try {
    Reader().Read(handle.get(), image);
  } catch (const std::invalid_argument& problem) {
    return hal::MakeFault(Status::kUnsupported, "%s: %s; want a plain grey PNG of 8 or 16 bits",
                          file.c_str(), problem.what());
  } catch (const std::exception& problem) {
    const bool cut = std::feof(handle.get()) != 0;
    return hal::MakeFault(cut ? Status::kTruncated : Status::kCorrupt, "%s: %s", file.c_str(),
                          problem.what());
  }
  return {};
}

hal::Fault WritePng(const std::string& file, int width_px, int height_px, int channels,
                    std::span<const std::uint8_t> pixels) {
  File handle(std::fopen(file.c_str(), "wb"));
  if (!handle)
    return hal::MakeFault(Status::kIoError, "%s: %s", file.c_str(), std::strerror(errno));
  try {
    Writer().Write(handle.get(), width_px, height_px, channels, pixels);
  } catch (const std::exception& problem) {
    return hal::MakeFault(Status::kIoError, "%s: %s", file.c_str(), problem.what());
  }
  if (std::fclose(handle.release()) != 0) {
    return hal::MakeFault(Status::kIoError, "%s: %s", file.c_str(), std::strerror(errno));
  }
  return {};
}

}  // namespace disflow::host
