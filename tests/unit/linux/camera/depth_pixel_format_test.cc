// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/camera/depth_pixel_format.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <array>
#include <vector>

#include "disflow/posix/camera/camera_model.h"

namespace disflow::posix {
namespace {

template <std::size_t kSize>
std::array<std::byte, kSize> Bytes(const unsigned (&values)[kSize]) {
  std::array<std::byte, kSize> bytes{};
  for (std::size_t i = 0; i < kSize; ++i) bytes[i] = static_cast<std::byte>(values[i]);
  return bytes;
}

TEST(DepthPixelFormat, EveryName_IsFoundAndHasACodeOfItsOwn) {
  for (const auto formats : {V4l2DepthFormats(), LibcameraDepthFormats()}) {
    for (const DepthPixelFormat& format : formats) {
      EXPECT_EQ(FindFormat(formats, format.name), &format);
      EXPECT_EQ(FindFormat(formats, format.fourcc), &format);
    }
    EXPECT_EQ(FindFormat(formats, "YUYV"), nullptr);
  }
}

TEST(DepthPixelFormat, BigEndianRow_ComesOutInHostOrder) {
  const auto* format = FindFormat(V4l2DepthFormats(), "Y16_BE");
  const auto row = Bytes({0x12, 0x34, 0xFF, 0x00});
  std::array<std::uint16_t, 2> pixels{};
  ASSERT_EQ(MinRowBytes(*format, 2), row.size());
  ConvertRow(*format, row.data(), pixels);
  EXPECT_EQ(pixels, (std::array<std::uint16_t, 2>{0x1234, 0xFF00}));
}

TEST(DepthPixelFormat, PackedRows_ComeOutWithAllTheirBits) {
  const auto* twelve = FindFormat(LibcameraDepthFormats(), "R12_CSI2P");
  const auto row12 = Bytes({0xAB, 0x12, 0x3C, 0xFF, 0x00, 0x0F});
  std::array<std::uint16_t, 3> three{};
  ASSERT_EQ(MinRowBytes(*twelve, 3), row12.size());
  ConvertRow(*twelve, row12.data(), three);
  EXPECT_EQ(three, (std::array<std::uint16_t, 3>{0xABC, 0x123, 0xFFF}));

  const auto* ten = FindFormat(LibcameraDepthFormats(), "R10_CSI2P");
  const auto row10 = Bytes({0xFF, 0x00, 0x80, 0x01, 0b11'10'01'00});
  std::array<std::uint16_t, 4> four{};
  ASSERT_EQ(MinRowBytes(*ten, 4), row10.size());
  ConvertRow(*ten, row10.data(), four);
  EXPECT_EQ(four, (std::array<std::uint16_t, 4>{0x3FC, 0x001, 0x202, 0x007}));
}

TEST(DepthPixelFormat, Code_IsShownAsLettersWhateverItHolds) {
  EXPECT_STREQ(FourccText(V4L2_PIX_FMT_Z16).text.data(), "Z16 ");
  EXPECT_STREQ(FourccText(V4L2_PIX_FMT_Y16_BE).text.data(), "Y16 -BE");
  EXPECT_STREQ(FourccText(0x0A0B0C0D).text.data(), "????");
}

TEST(CameraModel, KnownModels_HaveTheirMakersUnit) {
  ASSERT_NE(FindCameraModel(0x8086, 0x0B07), nullptr);
  EXPECT_FLOAT_EQ(FindCameraModel(0x8086, 0x0B07)->unit_m, 0.001F);
  EXPECT_FLOAT_EQ(FindCameraModel(0x8086, 0x0B64)->unit_m, 0.00025F);
  EXPECT_FLOAT_EQ(FindCameraModel(0x8086, 0x0AA5)->unit_m, 0.000125F);
  EXPECT_EQ(FindCameraModel(0x046D, 0x0B07), nullptr);
}

}  // namespace
}  // namespace disflow::posix
