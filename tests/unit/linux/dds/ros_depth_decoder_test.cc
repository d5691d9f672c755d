// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/ros/ros_depth_decoder.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

#include "disflow/host/png_image.h"
#include "scratch_dir.h"

namespace disflow::posix {
namespace {

using Bytes = std::vector<std::uint8_t>;
using hal::Fault;

struct Layout {
  std::uint32_t width_px;
  std::uint32_t height_px;
  std::size_t padding;
  bool big_endian;
};

/// Any bits, as pixels of either format.
template <class Pixel>
std::vector<Pixel> RandomPixels(const Layout& layout, std::mt19937& random) {
  std::vector<Pixel> pixels(std::size_t{layout.width_px} * layout.height_px);
  for (Pixel& pixel : pixels) {
    const auto bits = static_cast<std::uint32_t>(random());
    std::memcpy(&pixel, &bits, sizeof(pixel));
  }
  return pixels;
}

/// As a driver lays them out; the last row without padding, which is the least that is allowed.
template <class Pixel>
Bytes LayOut(const std::vector<Pixel>& pixels, const Layout& layout) {
  const std::size_t row = layout.width_px * sizeof(Pixel);
  const std::size_t step = row + layout.padding;
  Bytes bytes((layout.height_px - 1) * step + row, 0xA5);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    std::uint8_t* const at =
        bytes.data() + i / layout.width_px * step + i % layout.width_px * sizeof(Pixel);
    std::memcpy(at, &pixels[i], sizeof(Pixel));
    if (layout.big_endian != (std::endian::native == std::endian::big)) {
      std::reverse(at, at + sizeof(Pixel));
    }
  }
  return bytes;
}

template <class Pixel>
void ExpectSamePixels(const DepthView& depth, const std::vector<Pixel>& pixels) {
  const auto width = static_cast<std::size_t>(depth.width_px);
  ASSERT_EQ(width * static_cast<std::size_t>(depth.height_px), pixels.size());
  for (int v = 0; v < depth.height_px; ++v) {
    // Bits, since any two NaN differ.
    ASSERT_EQ(std::memcmp(depth.row(v), &pixels[static_cast<std::size_t>(v) * width],
                          width * sizeof(Pixel)),
              0)
        << "row " << v;
  }
}

template <class Pixel>
void CheckLayout(const char* encoding, const Layout& layout, std::mt19937& random) {
  const auto pixels = RandomPixels<Pixel>(layout, random);
  Bytes bytes = LayOut(pixels, layout);
  DepthView depth;
  const Fault fault = RosDepthDecoder().Decode(
      {.encoding = encoding,
       .width_px = layout.width_px,
       .height_px = layout.height_px,
       .step_bytes = static_cast<std::uint32_t>(layout.width_px * sizeof(Pixel) + layout.padding),
       .is_big_endian = layout.big_endian,
       .data = bytes},
      depth);
  ASSERT_TRUE(fault.ok()) << fault.message;
  EXPECT_EQ(depth.bytes_per_pixel(), static_cast<int>(sizeof(Pixel)));
  EXPECT_EQ(depth.unit_m, 0.001F);
  EXPECT_EQ(depth.stride_bytes % static_cast<std::ptrdiff_t>(sizeof(Pixel)), 0);
  ExpectSamePixels(depth, pixels);
}

TEST(RosDepthDecoder, AnyStepAndByteOrder_GiveThePixelsThatWereSent) {
  std::mt19937 random(1);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Layout layout{1 + static_cast<std::uint32_t>(random()) % 40,
                        1 + static_cast<std::uint32_t>(random()) % 30, i % 9, i % 2 != 0};
    CheckLayout<std::uint16_t>("16UC1", layout, random);
    CheckLayout<float>("32FC1", layout, random);
  }
}

struct Wrong {
  RosImage image;
  Status status;
  const char* said;
};
TEST(RosDepthDecoder, ImageThatContradictsItself_IsRefusedInWords) {
  Bytes bytes(64);
  for (const Wrong& wrong : std::to_array<Wrong>({
           {{"rgb8", 4, 4, 12, false, bytes}, Status::kUnsupported, "rgb8"},
           {{"", 4, 4, 8, false, bytes}, Status::kUnsupported, "is no depth"},
           {{"16UC1", 0, 4, 8, false, bytes}, Status::kCorrupt, "0 x 4"},
           {{"16UC1", 4, 0, 8, false, bytes}, Status::kCorrupt, "4 x 0"},
           {{"16UC1", 4, 4, 7, false, bytes}, Status::kCorrupt, "step 7"},
           {{"16UC1", 4, 4, 0, false, bytes}, Status::kCorrupt, "step 0"},
           {{"32FC1", 4, 5, 16, false, bytes}, Status::kTruncated, "64 of 80 bytes"},
           {{"16UC1", 4, 4, 0xFFFFFFFF, false, bytes}, Status::kTruncated, "64 of"},
           {{"16UC1", 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF, false, bytes},
            Status::kImageTooLarge,
            "4294967295"},
           {{"16UC1", 8192, 8192, 16384, false, bytes}, Status::kImageTooLarge, "8192 x 8192"},
       })) {
    DepthView depth;
    const Fault fault = RosDepthDecoder().Decode(wrong.image, depth);
    EXPECT_EQ(fault.status, wrong.status) << fault.message;
    EXPECT_NE(std::string(fault.message).find(wrong.said), std::string::npos) << fault.message;
  }
}

TEST(RosDepthDecoder, StepOfASingleRow_IsOfNoUseAndDoesNoHarm) {
  Bytes bytes = {1, 2, 3, 4};
  DepthView depth;
  ASSERT_TRUE(RosDepthDecoder().Decode({"16UC1", 2, 1, 0xFFFFFFFF, false, bytes}, depth).ok());
  EXPECT_EQ(depth.stride_bytes, 4);
}

TEST(RosDepthDecoder, EncodingOfAnyBytes_IsSaidInPrintableWords) {
  Bytes bytes(64);
  DepthView depth;
  const std::string encoding = "\x1b[2J\n" + std::string(10'000, '\xFF');
  const Fault fault = RosDepthDecoder().Decode({encoding, 4, 4, 8, false, bytes}, depth);
  for (const char c : std::string(fault.message)) EXPECT_TRUE(c >= ' ' && c <= '~');
}

/// `data` of a CompressedImage.
Bytes Packed(const apps::ScratchDir& dir, const std::vector<std::uint16_t>& values, int width_px,
             int height_px, float a = 0.0F, float b = 0.0F) {
  const auto file = dir.path() / "depth.png";
  EXPECT_TRUE(host::WriteGray16Png(file, values, width_px, height_px).ok());
  Bytes bytes(12);
  std::memcpy(bytes.data() + 4, &a, 4);
  std::memcpy(bytes.data() + 8, &b, 4);
  std::ifstream png(file, std::ios::binary);
  bytes.insert(bytes.end(), std::istreambuf_iterator<char>(png), {});
  return bytes;
}

TEST(RosDepthDecoder, CompressedMillimetres_ComeBackAsTheyWere) {
  const apps::ScratchDir dir;
  std::mt19937 random(2);
  const auto pixels = RandomPixels<std::uint16_t>({31, 17, 0, false}, random);
  const Bytes data = Packed(dir, pixels, 31, 17);
  for (const char* format : {"16UC1; compressedDepth png", "16UC1; compressedDepth", "16UC1"}) {
    RosDepthDecoder decoder;
    DepthView depth;
    const Fault fault = decoder.DecodeCompressed(format, data, depth);
    ASSERT_TRUE(fault.ok()) << fault.message;
    EXPECT_EQ(depth.format, DepthFormat::kUint16);
    ExpectSamePixels(depth, pixels);
  }
}

TEST(RosDepthDecoder, QuantisedMetres_AreOffByNoMoreThanTheirQuantum) {
  const apps::ScratchDir dir;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> metres(0.2F, 9.9F);
  // As compressed_depth_image_transport does it with its default parameters.
  constexpr float kA = 100.0F * 101.0F;
  constexpr float kB = 1.0F - kA / 10.0F;
  std::vector<float> sent(31 * 17);
  std::vector<std::uint16_t> values;
  for (float& z : sent) {
    z = values.size() % 7 == 0 ? 0.0F : metres(random);
    values.push_back(z > 0.0F ? static_cast<std::uint16_t>(kA / z + kB) : std::uint16_t{0});
  }
  RosDepthDecoder decoder;
  DepthView depth;
  ASSERT_TRUE(decoder
                  .DecodeCompressed("32FC1; compressedDepth png",
                                    Packed(dir, values, 31, 17, kA, kB), depth)
                  .ok());
  ASSERT_EQ(depth.format, DepthFormat::kFloat32);
  const auto* const z = static_cast<const float*>(depth.data);
  for (std::size_t i = 0; i < sent.size(); ++i) {
    // The sender rounds inverse depth down.
    const float quantum_m = 1.02F * z[i] * z[i] / kA + 1e-6F;
    EXPECT_GE(z[i], sent[i] - 1e-6F);
    EXPECT_LE(z[i], sent[i] + quantum_m);
    EXPECT_EQ(z[i] == 0.0F, sent[i] == 0.0F);
  }
}

TEST(RosDepthDecoder, CompressedImageThatCannotBeRead_IsRefusedInWords) {
  const apps::ScratchDir dir;
  const std::vector<std::uint16_t> pixels(12, 1000);
  const Bytes good = Packed(dir, pixels, 4, 3);
  Bytes cut = good;
  cut.resize(good.size() - 20);
  Bytes huge = good;
  huge[12 + 16] = 0x7F;
  Bytes narrow = good;
  narrow[12 + 24] = 8;
  struct Case {
    const char* format;
    const Bytes& data;
    Status status;
    const char* said;
  };
  const Bytes empty;
  for (const Case& wrong : {
           Case{"16UC1; compressedDepth rvl", good, Status::kUnsupported, "format to png"},
           Case{"16UC1; jpeg compressed", good, Status::kUnsupported, "cannot be read"},
           Case{"bgr8; compressedDepth png", good, Status::kUnsupported, "is no depth"},
           Case{"16UC1; compressedDepth", empty, Status::kTruncated, "0 bytes"},
           Case{"16UC1; compressedDepth", cut, Status::kTruncated, "PNG"},
           Case{"16UC1; compressedDepth", huge, Status::kImageTooLarge, "2130706436 x 3"},
           Case{"16UC1; compressedDepth", narrow, Status::kCorrupt, "8 bits"},
           // Without parameters nothing can be told of the depth.
           Case{"32FC1; compressedDepth", good, Status::kCorrupt, "quantisation"},
       }) {
    RosDepthDecoder decoder;
    DepthView depth;
    const Fault fault = decoder.DecodeCompressed(wrong.format, wrong.data, depth);
    EXPECT_EQ(fault.status, wrong.status) << wrong.format << ": " << fault.message;
    EXPECT_NE(std::string(fault.message).find(wrong.said), std::string::npos) << fault.message;
  }
}

TEST(RosDepthDecoder, SizeThatWasFixed_IsTheOnlyOneThatIsUnpacked) {
  const apps::ScratchDir dir;
  RosDepthDecoder decoder;
  decoder.FixSize(4, 3);
  DepthView depth;
  Bytes raw(100 * 100 * 2);
  EXPECT_EQ(decoder.Decode({"16UC1", 100, 100, 200, false, raw}, depth).status,
            Status::kImageTooLarge);
  EXPECT_TRUE(decoder.Decode({"16UC1", 4, 3, 8, false, raw}, depth).ok());
  const Bytes larger = Packed(dir, std::vector<std::uint16_t>(10'000), 100, 100);
  EXPECT_EQ(decoder.DecodeCompressed("16UC1", larger, depth).status, Status::kImageTooLarge);
  EXPECT_TRUE(
      decoder.DecodeCompressed("16UC1", Packed(dir, std::vector<std::uint16_t>(12), 4, 3), depth)
          .ok());
}

TEST(RosDepthDecoder, DamagedPng_IsAnImageOfItsSizeOrRefused) {
  const apps::ScratchDir dir;
  std::mt19937 random(5);
  const auto pixels = RandomPixels<std::uint16_t>({31, 17, 0, false}, random);
  const Bytes good = Packed(dir, pixels, 31, 17);
  RosDepthDecoder decoder;
  decoder.FixSize(31, 17);
  for (int i = 0; i < 2000; ++i) {
    Bytes data = good;
    for (int n = 0; n < 3; ++n) data[random() % data.size()] = static_cast<std::uint8_t>(random());
    if (i % 3 == 0) data.resize(random() % data.size());
    DepthView depth;
    if (!decoder.DecodeCompressed("16UC1; compressedDepth", data, depth).ok()) continue;
    EXPECT_EQ(depth.width_px, 31);
    EXPECT_EQ(depth.height_px, 17);
  }
}

}  // namespace
}  // namespace disflow::posix
