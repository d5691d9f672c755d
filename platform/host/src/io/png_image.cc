// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/png_image.h"

#include <png.h>

#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>

#include "disflow/host/file_output.h"
#include "disflow/host/image_limits.h"
#include "disflow/host/regular_file.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

struct FileCloser {
  void operator()(std::FILE* file) const { (void)std::fclose(file); }
};
using FilePointer = std::unique_ptr<std::FILE, FileCloser>;

/// What libpng's error callback leaves behind before it jumps.
struct PngError {
  char text[128] = {};
  bool too_large = false;  ///< A side is longer than was allowed.
};

[[noreturn]] void OnError(png_structp png, png_const_charp message) {
  auto* error = static_cast<PngError*>(png_get_error_ptr(png));
  (void)std::snprintf(error->text, sizeof(error->text), "%s", message);
  png_longjmp(png, 1);
}
/// libpng says why it refuses a header only in the warnings before.
void OnWarning(png_structp png, png_const_charp message) {
  auto* error = static_cast<PngError*>(png_get_error_ptr(png));
  if (std::strstr(message, "exceeds user limit") != nullptr) error->too_large = true;
}

/// What a file could make libpng allocate or unpack beside the pixels: none of it is needed.
void RefuseExtras(png_structp png) {
  constexpr png_alloc_size_t kMaxChunk_bytes = 65536;
  constexpr png_uint_32 kMaxKeptChunks = 1;
  constexpr int kAllAncillary = -1;
  png_set_user_limits(png, kMaxImageSide_px, kMaxImageSide_px);
  png_set_chunk_malloc_max(png, kMaxChunk_bytes);
  png_set_chunk_cache_max(png, kMaxKeptChunks);
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, kAllAncillary);
}

hal::Fault OpenFault(const fs::path& file) {
  const int error = errno;
  const Status status = error == ENOENT   ? Status::kNotFound
                        : error == EACCES ? Status::kPermissionDenied
                                          : Status::kIoError;
  return hal::MakeFault(status, "%s: %s", file.c_str(), std::strerror(error));
}

/// Owns libpng's reading state.
class Reader {
 public:
  Reader() : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &error_, OnError, OnWarning)) {
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// libpng leaves with longjmp, so nothing here may own memory.
  [[nodiscard]] Status ReadHeader(std::FILE* file) {
    if (png_ == nullptr || info_ == nullptr) return Status::kIoError;
    if (setjmp(png_jmpbuf(png_)) != 0)
      return error_.too_large ? Status::kImageTooLarge : Status::kCorrupt;
    RefuseExtras(png_);
    png_init_io(png_, file);
    png_read_info(png_, info_);
    if (png_get_color_type(png_, info_) != PNG_COLOR_TYPE_GRAY ||
        png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE) {
      return Status::kUnsupported;
    }
    if (png_get_bit_depth(png_, info_) < 8) png_set_expand_gray_1_2_4_to_8(png_);
    if (std::endian::native == std::endian::little) png_set_swap(png_);
    png_read_update_info(png_, info_);
    return Status::kOk;
  }
  [[nodiscard]] std::uint32_t width() const { return png_get_image_width(png_, info_); }
  [[nodiscard]] std::uint32_t height() const { return png_get_image_height(png_, info_); }

  /// @param pixels width() x height(), 16 bits each.
  [[nodiscard]] Status ReadPixels(std::uint16_t* pixels) {
    if (setjmp(png_jmpbuf(png_)) != 0) return Status::kTruncated;
    const bool wide = png_get_bit_depth(png_, info_) == 16;
    const std::size_t columns = width();
    for (std::size_t row = 0; row < height(); ++row) {
      std::uint16_t* const target = pixels + row * columns;
      png_read_row(png_, reinterpret_cast<png_bytep>(target), nullptr);
      if (wide) continue;
      // Widen in place, from the end so that no byte is overwritten before it is read.
      const auto* const bytes = reinterpret_cast<const std::uint8_t*>(target);
      for (std::size_t i = columns; i-- > 0;) target[i] = bytes[i];
    }
    png_read_end(png_, nullptr);
    return Status::kOk;
  }
  [[nodiscard]] const char* error() const { return error_.text; }

 private:
  PngError error_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

/// Before anything is allocated for the pixels.
hal::Fault CheckSize(const char* name, const Reader& reader, std::uintmax_t bytes) {
  const std::uint64_t pixels = std::uint64_t{reader.width()} * reader.height();
  if (pixels > kMaxImagePixels) {
    return hal::MakeFault(Status::kImageTooLarge,
                          "%s: its header says %ux%u pixels; %ju can be read", name, reader.width(),
                          reader.height(), std::uintmax_t{kMaxImagePixels});
  }
  // Deflate cannot say more than 1032 bytes with one.
  constexpr std::uint64_t kPixelsPerByte = 8 * 1032;  // of one bit each
  if (pixels / kPixelsPerByte <= bytes) return {};
  return hal::MakeFault(Status::kTruncated,
                        "%s: is %ju bytes long, too short for the %ux%u pixels of its header", name,
                        bytes, reader.width(), reader.height());
}

/// @param bytes Length of the file.
hal::Fault Read(std::FILE* file, const char* name, std::uintmax_t bytes, GrayImage& image) {
  Reader reader;
  if (const Status status = reader.ReadHeader(file); status != Status::kOk) {
    if (status == Status::kImageTooLarge) {
      return hal::MakeFault(status, "%s: its header says more than %u pixels a side", name,
                            kMaxImageSide_px);
    }
    const char* reason = status == Status::kUnsupported
                             ? "is not a plain grey PNG; 8 or 16 bit grey is needed"
                             : reader.error();
    return hal::MakeFault(status, "%s: %s", name, reason);
  }
  if (const hal::Fault fault = CheckSize(name, reader, bytes); !fault.ok()) return fault;
  image.width_px = static_cast<int>(reader.width());
  image.height_px = static_cast<int>(reader.height());
  image.pixels.resize(std::size_t{reader.width()} * reader.height());
  if (const Status status = reader.ReadPixels(image.pixels.data()); status != Status::kOk) {
    return hal::MakeFault(status, "%s: ends too early or is damaged: %s", name, reader.error());
  }
  return {};
}

/// Rows of an image to be written.
struct Raster {
  const std::uint8_t* first_row;
  std::ptrdiff_t stride_bytes;
  int width_px;
  int height_px;
  int color_type;
  int bit_depth;
};

/// @return false after an error, whose text is in `error`.
bool EncodePng(std::FILE* file, const Raster& raster, PngError& error) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, OnError, OnWarning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_init_io(png, file);
  constexpr int kFastest = 1;
  png_set_compression_level(png, kFastest);
  png_set_IHDR(png, info, static_cast<png_uint_32>(raster.width_px),
               static_cast<png_uint_32>(raster.height_px), raster.bit_depth, raster.color_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if (std::endian::native == std::endian::little && raster.bit_depth == 16) png_set_swap(png);
  for (int row = 0; row < raster.height_px; ++row) {
    png_write_row(png, raster.first_row + row * raster.stride_bytes);
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

/// @param png Empty after an error, whose text is in `error`.
void EncodePng(const Raster& raster, std::string& png, PngError& error) {
  char* bytes = nullptr;
  std::size_t size = 0;
  FilePointer memory(::open_memstream(&bytes, &size));
  const bool encoded = memory != nullptr && EncodePng(memory.get(), raster, error);
  memory.reset();
  png.clear();
  if (encoded) png.assign(bytes, size);
  std::free(bytes);
}

hal::Fault WritePng(const fs::path& path, const Raster& raster) {
  std::string png;
  PngError error;
  EncodePng(raster, png, error);
  if (!png.empty()) return WriteWholeFile(path, png);
  return hal::MakeFault(Status::kIoError, "%s: cannot be written: %s", path.c_str(),
                        error.text[0] != '\0' ? error.text : "out of memory");
}

}  // namespace

hal::Fault ReadGrayPng(const fs::path& path, GrayImage& image) {
  // Every caller reads a file of a recording.
  const hal::Fault fault = CheckRegularFile(path);
  if (!fault.ok()) return fault;
  const FilePointer file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) return OpenFault(path);
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(path, error);
  // Of what has lost its length meanwhile none is expected.
  return Read(file.get(), path.c_str(), error ? UINTMAX_MAX : bytes, image);
}

hal::Fault ReadGrayPng(std::span<const std::uint8_t> png, const char* name, GrayImage& image) {
  if (png.empty()) return hal::MakeFault(Status::kTruncated, "%s: is empty", name);
  // Only read: the mode says so.
  const FilePointer file(::fmemopen(const_cast<std::uint8_t*>(png.data()), png.size(), "rb"));
  if (file == nullptr) return hal::MakeFault(Status::kIoError, "%s: out of memory", name);
  return Read(file.get(), name, png.size(), image);
}

hal::Fault WriteGray8Png(const fs::path& file, const std::uint8_t* rows, int width_px,
                         int height_px, std::ptrdiff_t stride_bytes) {
  return WritePng(file, {rows, stride_bytes, width_px, height_px, PNG_COLOR_TYPE_GRAY, 8});
}

hal::Fault WriteGray16Png(const fs::path& file, std::span<const std::uint16_t> pixels, int width_px,
                          int height_px) {
  return WritePng(
      file, {reinterpret_cast<const std::uint8_t*>(pixels.data()), std::ptrdiff_t{2} * width_px,
             width_px, height_px, PNG_COLOR_TYPE_GRAY, 16});
}

std::string EncodeRgbPng(std::span<const std::uint8_t> pixels, int width_px, int height_px) {
  std::string png;
  PngError error;
  EncodePng(
      {pixels.data(), std::ptrdiff_t{3} * width_px, width_px, height_px, PNG_COLOR_TYPE_RGB, 8},
      png, error);
  return png;
}

}  // namespace disflow::host
