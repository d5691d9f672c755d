// SPDX-License-Identifier: BSD-3-Clause
#include "settings/camera_file.h"

#include <gtest/gtest.h>

#include "camera_file_fixture.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

constexpr const char* kComplete =
    "width = 640\nheight = 480\nfx = 570.5\nfy = 571\ncx = 319.5\ncy = 239.5\n";

class CameraFileTest : public CameraFileFixture {
 protected:
  CameraFileTest() : CameraFileFixture("camera.toml") {}
};

TEST_F(CameraFileTest, AllNumbers_AreTaken) {
  const posix::CameraDescription read = Read(std::string(kComplete) + "depth_scale = 0.00025\n");
  EXPECT_EQ(read.width_px, 640);
  EXPECT_EQ(read.height_px, 480);
  EXPECT_EQ(read.camera.fx_px, 570.5F);
  EXPECT_EQ(read.camera.fy_px, 571.0F);
  EXPECT_EQ(read.camera.cx_px, 319.5F);
  EXPECT_EQ(read.camera.cy_px, 239.5F);
  EXPECT_EQ(read.unit_m, 0.00025F);
}

TEST_F(CameraFileTest, WhoeverRectifies_ItsNumbersAreOfTheImagesThatCome) {
  EXPECT_EQ(Read(kComplete, true).camera.fx_px, 570.5F);
}

TEST_F(CameraFileTest, WithoutDepthScale_ItIsNotSaid) { EXPECT_EQ(Read(kComplete).unit_m, 0.0F); }

TEST_F(CameraFileTest, EachMissingNumber_IsNamed) {
  for (const char* key : {"width", "height", "fx", "fy", "cx", "cy"}) {
    std::string text = kComplete;
    const std::size_t begin = text.find(std::string(key) + " =");
    text.erase(begin, text.find('\n', begin) - begin);
    EXPECT_NE(Refusal(text).find(std::string(key) + " is missing"), std::string::npos)
        << Refusal(text);
  }
}

TEST_F(CameraFileTest, NumbersOutOfRange_AreRefusedWithFileLineAndRange) {
  for (const char* line :
       {"depth_scale = 0", "depth_scale = 1.5", "depth_scale = nan", "depth_scale = -inf",
        "depth_scale = \"0.001\"", "depth_scale = [0.001]"}) {
    const std::string said = Refusal(std::string(kComplete) + line);
    EXPECT_NE(said.find("camera.toml"), std::string::npos) << said;
    EXPECT_NE(said.find("7"), std::string::npos) << said;
    EXPECT_NE(said.find("depth_scale is not a number from"), std::string::npos) << said;
  }
}

TEST_F(CameraFileTest, WidthThatIsNotWhole_IsRefused) {
  std::string text = kComplete;
  text.replace(text.find("640"), 3, "640.5");
  EXPECT_NE(Refusal(text).find("width is not a whole number"), std::string::npos);
}

TEST_F(CameraFileTest, UnknownKeyOrBrokenText_IsRefused) {
  EXPECT_NE(Refusal(std::string(kComplete) + "focal = 3\n").find("focal is not known"),
            std::string::npos);
  EXPECT_NE(Refusal("width = = 3").find("camera.toml"), std::string::npos);
  EXPECT_NE(Refusal(""), "");
  EXPECT_THROW((void)ReadCameraFile(Path("missing.toml")), Failure);
}

}  // namespace
}  // namespace disflow::apps
