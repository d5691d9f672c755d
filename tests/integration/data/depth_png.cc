// SPDX-License-Identifier: BSD-3-Clause
#include "depth_png.h"

#include <png.h>

#include <cstdio>
#include <memory>
#include <stdexcept>

namespace disflow::test {

DepthPng ReadDepthPng(const std::filesystem::path& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"),
                                                               std::fclose);
  if (stream == nullptr) throw std::runtime_error(file.string() + " cannot be opened");
  const auto raise = [](png_structp, png_const_charp text) { throw std::runtime_error(text); };
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, raise, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, stream.get());
  png_read_png(png, info, PNG_TRANSFORM_SWAP_ENDIAN, nullptr);
  if (png_get_bit_depth(png, info) != 16)
    throw std::runtime_error(file.string() + " has no 16 bits");
  DepthPng image;
  image.width_px = static_cast<int>(png_get_image_width(png, info));
  image.height_px = static_cast<int>(png_get_image_height(png, info));
  png_bytepp rows = png_get_rows(png, info);
  for (int v = 0; v < image.height_px; ++v) {
    const auto* const row = reinterpret_cast<const std::uint16_t*>(rows[v]);
    image.pixels.insert(image.pixels.end(), row, row + image.width_px);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return image;
}

}  // namespace disflow::test
