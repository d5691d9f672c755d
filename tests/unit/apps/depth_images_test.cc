// SPDX-License-Identifier: BSD-3-Clause
#include "depth_images.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "disflow/depth/depth_reader.h"
#include "errors.h"
#include "scratch_dir.h"
#include "visibility.h"

namespace disflow::apps {
namespace {

using testing::IsSubstring;

constexpr const char* kCamera =
    R"({"width": 4, "height": 3, "fx": 10.0, "fy": 10, "cx": 1.5, "cy": 1.0})";

std::string Image(std::uint64_t width, std::uint64_t height, float depth_m) {
  std::string bytes(16 + 4 * width * height, '\0');
  std::memcpy(bytes.data(), &width, 8);
  std::memcpy(bytes.data() + 8, &height, 8);
  for (std::size_t i = 16; i < bytes.size(); i += 4) std::memcpy(&bytes[i], &depth_m, 4);
  return bytes;
}

class DepthImagesTest : public testing::Test {
 protected:
  void SetUp() override { dir_.Write("cam_K.json", kCamera); }
  /// A sequence of one frame whose model is a triangle.
  void WriteTruth(const std::string& poses) {
    dir_.Write("gt/poses.txt", poses);
    dir_.Write("gt/model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  std::string RefusalOfImage(const std::string& bytes) {
    dir_.Write("depth/0.float", bytes);
    return MessageOf<InputError>([&] { (void)DepthImages(dir_.path()).Load(0); });
  }
  std::string RefusalOfCamera(const std::string& text) {
    dir_.Write("cam_K.json", text);
    return MessageOf<InputError>([&] { (void)DepthImages(dir_.path()); });
  }

  ScratchDir dir_;
};

TEST_F(DepthImagesTest, Image_IsReadWithItsCamera) {
  dir_.Write("depth/7.float", Image(4, 3, 0.75F));
  DepthImages images(dir_.path());
  EXPECT_FALSE(images.Has(0));
  ASSERT_TRUE(images.Has(7));
  const DepthFrame frame = images.Load(7);
  EXPECT_EQ(CheckFrame(frame, 100, 100), Status::kOk);
  EXPECT_EQ(DepthReader(frame.depth, 0.0F, 10.0F).At(3, 2), 0.75F);
  EXPECT_EQ(frame.camera.cx_px, 1.5F);
}

TEST_F(DepthImagesTest, TruncatedLongOrWronglySizedImage_IsRefused) {
  const std::string good = Image(4, 3, 1.0F);
  for (const std::string& bad : {std::string(), good.substr(0, 10), good.substr(0, 60), good + "x",
                                 Image(3, 4, 1.0F), Image(5, 3, 1.0F)}) {
    EXPECT_PRED_FORMAT2(IsSubstring, "0.float: is truncated or not the 4 x 3 image",
                        RefusalOfImage(bad));
  }
}

TEST_F(DepthImagesTest, CameraFileThatLacksOrBendsAnEntry_IsRefused) {
  EXPECT_PRED_FORMAT2(IsSubstring, "is no JSON object", RefusalOfCamera("{"));
  EXPECT_PRED_FORMAT2(IsSubstring, "is no JSON object", RefusalOfCamera("[1]"));
  EXPECT_PRED_FORMAT2(IsSubstring, "'fx'", RefusalOfCamera("{}"));
  EXPECT_PRED_FORMAT2(IsSubstring, "'fx'", RefusalOfCamera(R"({"fx": "10"})"));
  EXPECT_PRED_FORMAT2(IsSubstring, "'fx'", RefusalOfCamera(R"({"fx": 0})"));
  EXPECT_PRED_FORMAT2(
      IsSubstring, "'width'",
      RefusalOfCamera(R"({"fx": 1, "fy": 1, "cx": 1, "cy": 1, "width": 1e12, "height": 3})"));
}

TEST_F(DepthImagesTest, SequenceOfImages_ShowsThePointsOnTheirSurface) {
  dir_.Write("depth/0.float", Image(4, 3, 1.0F));
  WriteTruth("0 0 0.5 0 0 1 0\n");
  std::vector<SurfacePoint> points(2);
  points[0].position = Vec3d(0, 0, 0.5);
  points[1].position = Vec3d(0, 0, 0.4);
  EXPECT_EQ(FindSeen(OpenSequence(dir_.path()), points), (std::vector<bool>{true, false}));
}

TEST_F(DepthImagesTest, NoImagesOrNoCamera_MeansNotKnown) {
  WriteTruth("0 0 0 0 0 1 0\n");
  EXPECT_TRUE(FindSeen(OpenSequence(dir_.path()), std::vector<SurfacePoint>(2)).empty());
  std::filesystem::remove(dir_.path() / "cam_K.json");
  EXPECT_TRUE(FindSeen(OpenSequence(dir_.path()), std::vector<SurfacePoint>(2)).empty());
}

}  // namespace
}  // namespace disflow::apps
