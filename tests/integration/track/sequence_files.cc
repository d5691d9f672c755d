// SPDX-License-Identifier: BSD-3-Clause
#include "sequence_files.h"

#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <fstream>

#include "scratch_folder.h"

namespace disflow::test {

namespace fs = std::filesystem;

fs::path SequenceFiles::depth(int frame) const {
  return folder_ / "depth" / (std::to_string(frame) + ".float");
}

fs::path SequenceFiles::mask(int frame) const {
  std::string ending = "_";
  ending.append(std::to_string(frame)).append(".png");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "masks" / "gt")) {
    if (entry.path().filename().string().ends_with(ending)) return entry.path();
  }
  ADD_FAILURE() << "no mask for frame " << frame;
  return {};
}

DepthFile ReadDepth(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::array<std::uint64_t, 2> size{};
  stream.read(reinterpret_cast<char*>(size.data()), sizeof(size));
  DepthFile depth{size[0], size[1], std::vector<float>(size[0] * size[1])};
  stream.read(reinterpret_cast<char*>(depth.depth_m.data()),
              static_cast<std::streamsize>(depth.depth_m.size() * sizeof(float)));
  EXPECT_TRUE(stream.good()) << file;
  return depth;
}

void WriteDepth(const fs::path& file, const DepthFile& depth) {
  std::ofstream stream(file, std::ios::binary);
  const std::array<std::uint64_t, 2> size = {depth.width_px, depth.height_px};
  stream.write(reinterpret_cast<const char*>(size.data()), sizeof(size));
  stream.write(reinterpret_cast<const char*>(depth.depth_m.data()),
               static_cast<std::streamsize>(depth.depth_m.size() * sizeof(float)));
}

void WriteMask(const fs::path& file, int width_px, int height_px, std::uint8_t value) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_px);
  image.height = static_cast<png_uint_32>(height_px);
  image.format = PNG_FORMAT_GRAY;
  const std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width_px * height_px), value);
  EXPECT_NE(png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, nullptr), 0);
}

void Truncate(const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); }

void ReplaceText(const fs::path& file, const std::string& old_text, const std::string& new_text) {
  std::string text = ReadFile(file);
  const std::size_t at = text.find(old_text);
  ASSERT_NE(at, std::string::npos) << old_text << " is not in " << file;
  WriteFile(file, text.replace(at, old_text.size(), new_text));
}

}  // namespace disflow::test
