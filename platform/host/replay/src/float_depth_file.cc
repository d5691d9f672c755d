// SPDX-License-Identifier: BSD-3-Clause
#include "float_depth_file.h"

#include <array>
#include <bit>
#include <cinttypes>
#include <cstdint>
#include <fstream>
#include <system_error>

#include "disflow/host/image_limits.h"
#include "disflow/host/regular_file.h"

namespace disflow::host {

static_assert(std::endian::native == std::endian::little, "the format is little endian");

hal::Fault ReadFloatDepth(const std::filesystem::path& file, FloatImage& image) {
  const hal::Fault fault = CheckRegularFile(file);
  if (!fault.ok()) return fault;
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream) {
    return hal::MakeFault(Status::kNotFound, "%s: cannot be opened", file.c_str());
  }
  std::array<std::uint64_t, 2> size{};
  if (!stream.read(reinterpret_cast<char*>(size.data()), sizeof(size))) {
    return hal::MakeFault(Status::kTruncated, "%s: ends within its header", file.c_str());
  }
  const auto [width, height] = size;
  if (width == 0 || height == 0 || width > kMaxImageSide_px || height > kMaxImageSide_px) {
    return hal::MakeFault(Status::kCorrupt,
                          "%s: header says %" PRIu64 " x %" PRIu64 " pixels; 1 to %u are possible",
                          file.c_str(), width, height, kMaxImageSide_px);
  }
  if (width * height > kMaxImagePixels) {
    return hal::MakeFault(Status::kCorrupt,
                          "%s: header says %" PRIu64 " x %" PRIu64 " pixels; %" PRIu64
                          " can be read",
                          file.c_str(), width, height, kMaxImagePixels);
  }
  const std::uint64_t needed = sizeof(size) + width * height * sizeof(float);
  if (bytes != needed) {
    return hal::MakeFault(bytes < needed ? Status::kTruncated : Status::kCorrupt,
                          "%s: is %ju bytes long; %" PRIu64 " are needed for %" PRIu64 " x %" PRIu64
                          " pixels",
                          file.c_str(), bytes, needed, width, height);
  }
  image.width_px = static_cast<int>(width);
  image.height_px = static_cast<int>(height);
  image.pixels.resize(static_cast<std::size_t>(width * height));
  stream.read(reinterpret_cast<char*>(image.pixels.data()),
              static_cast<std::streamsize>(width * height * sizeof(float)));
  if (stream) return {};
  return hal::MakeFault(Status::kIoError, "%s: cannot be read", file.c_str());
}

}  // namespace disflow::host
