// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/png_image.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "scratch_dir.h"

namespace disflow::host {
namespace {

using apps::ScratchDir;

constexpr int kWidth_px = 37;
constexpr int kHeight_px = 23;

std::vector<std::uint16_t> Pattern() {
  std::vector<std::uint16_t> pixels;
  for (int i = 0; i < kWidth_px * kHeight_px; ++i) {
    pixels.push_back(static_cast<std::uint16_t>(i * 7919));
  }
  return pixels;
}

std::string Bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(PngImage, SixteenBits_ComeBackAsWritten) {
  const ScratchDir dir;
  const auto file = dir.path() / "depth.png";
  ASSERT_TRUE(WriteGray16Png(file, Pattern(), kWidth_px, kHeight_px).ok());
  GrayImage image;
  const hal::Fault fault = ReadGrayPng(file, image);
  ASSERT_TRUE(fault.ok()) << fault.message;
  EXPECT_EQ(image.width_px, kWidth_px);
  EXPECT_EQ(image.height_px, kHeight_px);
  EXPECT_EQ(image.pixels, Pattern());
}

TEST(PngImage, EightBitsWithAStride_ComeBackAsWritten) {
  const ScratchDir dir;
  const auto file = dir.path() / "mask.png";
  constexpr int kStride = 40;
  std::vector<std::uint8_t> rows(kStride * kHeight_px, 99);
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      rows[static_cast<std::size_t>(v * kStride + u)] = (u + v) % 3 == 0 ? 255 : 0;
    }
  }
  ASSERT_TRUE(WriteGray8Png(file, rows.data(), kWidth_px, kHeight_px, kStride).ok());
  GrayImage image;
  ASSERT_TRUE(ReadGrayPng(file, image).ok());
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      ASSERT_EQ(image.pixels[static_cast<std::size_t>(v * kWidth_px + u)],
                (u + v) % 3 == 0 ? 255 : 0);
    }
  }
}

TEST(PngImage, CutAnywhere_IsNeverTakenForWhole) {
  const ScratchDir dir;
  const auto file = dir.path() / "depth.png";
  ASSERT_TRUE(WriteGray16Png(file, Pattern(), kWidth_px, kHeight_px).ok());
  const std::string whole = Bytes(file);
  for (std::size_t length = 0; length + 12 < whole.size(); length += 5) {
    const auto cut = dir.Write("cut.png", std::string_view(whole).substr(0, length));
    GrayImage image;
    const hal::Fault fault = ReadGrayPng(cut, image);
    ASSERT_TRUE(fault.status == Status::kTruncated || fault.status == Status::kCorrupt)
        << "cut after " << length << " bytes";
    ASSERT_NE(std::string(fault.message).find("cut.png"), std::string::npos);
  }
}

TEST(PngImage, DamagedByte_IsNoticed) {
  const ScratchDir dir;
  const auto file = dir.path() / "depth.png";
  ASSERT_TRUE(WriteGray16Png(file, Pattern(), kWidth_px, kHeight_px).ok());
  std::string bytes = Bytes(file);
  bytes[bytes.size() / 2] = static_cast<char>(~bytes[bytes.size() / 2]);
  GrayImage image;
  EXPECT_FALSE(ReadGrayPng(dir.Write("bad.png", bytes), image).ok());
}

TEST(PngImage, Colour_IsRefused) {
  const ScratchDir dir;
  const std::vector<std::uint8_t> pixels(3 * kWidth_px * kHeight_px, 100);
  const auto file = dir.Write("colour.png", EncodeRgbPng(pixels, kWidth_px, kHeight_px));
  GrayImage image;
  const hal::Fault fault = ReadGrayPng(file, image);
  EXPECT_EQ(fault.status, Status::kUnsupported);
  EXPECT_NE(std::string(fault.message).find("grey"), std::string::npos) << fault.message;
}

TEST(PngImage, AbsurdSize_IsRefusedBeforeAllocation) {
  const ScratchDir dir;
  const auto file = dir.path() / "huge.png";
  ASSERT_TRUE(WriteGray8Png(file, std::vector<std::uint8_t>(9000, 1).data(), 9000, 1, 9000).ok());
  GrayImage image;
  EXPECT_EQ(ReadGrayPng(file, image).status, Status::kImageTooLarge);
}

TEST(PngImage, FileTooShortForItsHeader_IsRefusedBeforeAllocation) {
  const ScratchDir dir;
  const auto file = dir.path() / "large.png";
  const std::vector<std::uint8_t> pixels(4096 * 4096, 0);
  ASSERT_TRUE(WriteGray8Png(file, pixels.data(), 4096, 4096, 4096).ok());
  GrayImage image;
  ASSERT_TRUE(ReadGrayPng(file, image).ok()) << "the largest there is, packed as well as can be";
  const auto cut = dir.Write("cut.png", Bytes(file).substr(0, 1000));
  image = {};
  EXPECT_EQ(ReadGrayPng(cut, image).status, Status::kTruncated);
  EXPECT_TRUE(image.pixels.empty());
}

TEST(PngImage, MissingFileAndUnwritableTarget_AreNamed) {
  const ScratchDir dir;
  GrayImage image;
  EXPECT_EQ(ReadGrayPng(dir.path() / "none.png", image).status, Status::kNotFound);
  const hal::Fault fault =
      WriteGray16Png(dir.path() / "no" / "folder.png", Pattern(), kWidth_px, kHeight_px);
  EXPECT_FALSE(fault.ok());
  EXPECT_NE(std::string(fault.message).find("folder.png"), std::string::npos);
}

}  // namespace
}  // namespace disflow::host
