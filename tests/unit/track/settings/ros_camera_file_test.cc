// SPDX-License-Identifier: BSD-3-Clause
#include "settings/ros_camera_file.h"

#include <gtest/gtest.h>

#include "camera_file_fixture.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

/// As camera_calibration writes it.
constexpr const char* kRectified = R"(image_width: 640
image_height: 480
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [570.5, 0, 319.5, 0, 571, 239.5, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0, 0, 0, 0, 0.000000]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
projection_matrix:
  rows: 3
  cols: 4
  data: [570.5, 0, 319.5, 0, 0, 571, 239.5, 0, 0, 0, 1, 0]
)";

constexpr const char* kProjection = "[570.5, 0, 319.5, 0, 0, 571, 239.5, 0, 0, 0, 1, 0]";

std::string Replaced(std::string text, const std::string& part, const std::string& instead) {
  return text.replace(text.find(part), part.size(), instead);
}

/// Of a lens that distorts: what is rectified has other intrinsics than what the lens shows.
std::string Distorted(const std::string& projection) {
  return Replaced(Replaced(kRectified, "[0, 0, 0, 0, 0.000000]", "[0.1, -0.2, 0, 0, 0]"),
                  kProjection, projection);
}

class RosCameraFileTest : public CameraFileFixture {
 protected:
  RosCameraFileTest() : CameraFileFixture("camera.yaml") {}
  /// What is said of the file with one text in place of another.
  [[nodiscard]] std::string Refusal(const std::string& part, const std::string& instead) const {
    return CameraFileFixture::Refusal(Replaced(kRectified, part, instead));
  }
  /// What is said of a projection matrix that is asked for.
  [[nodiscard]] std::string ProjectionRefusal(const std::string& projection) const {
    return CameraFileFixture::Refusal(Distorted(projection), true);
  }
};

TEST_F(RosCameraFileTest, RectifiedCamera_IsTakenWithTheUnitLeftOpen) {
  const posix::CameraDescription read = Read(kRectified);
  EXPECT_EQ(read.width_px, 640);
  EXPECT_EQ(read.height_px, 480);
  EXPECT_EQ(read.camera.fx_px, 570.5F);
  EXPECT_EQ(read.camera.fy_px, 571.0F);
  EXPECT_EQ(read.camera.cx_px, 319.5F);
  EXPECT_EQ(read.camera.cy_px, 239.5F);
  EXPECT_EQ(read.unit_m, 0.0F);
}

TEST_F(RosCameraFileTest, FileWithoutDistortion_IsTaken) {
  const std::string text = kRectified;
  const std::size_t begin = text.find("distortion_model");
  const std::string without =
      text.substr(0, begin) + text.substr(text.find("rectification_matrix"));
  EXPECT_EQ(Read(without).camera.fx_px, 570.5F);
}

TEST_F(RosCameraFileTest, DistortedCamera_IsRefusedWithItsLineAndWhatToDo) {
  const std::string said = Refusal("[0, 0, 0, 0, 0.000000]", "[0.1, -0.2, 0, 0, 0]");
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "camera.yaml:10: the camera is distorted", said);
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "rectified=yes", said);
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "image_proc", said);
}

TEST_F(RosCameraFileTest, ImagesThatTheDriverRectifies_HaveTheIntrinsicsOfP) {
  const posix::CameraDescription read =
      Read(Distorted("[520.5, 0, 310.5, 0, 0, 521, 230.5, 0, 0, 0, 1, 0]"), true);
  EXPECT_EQ(read.width_px, 640);
  EXPECT_EQ(read.height_px, 480);
  EXPECT_EQ(read.camera.fx_px, 520.5F);
  EXPECT_EQ(read.camera.fy_px, 521.0F);
  EXPECT_EQ(read.camera.cx_px, 310.5F);
  EXPECT_EQ(read.camera.cy_px, 230.5F);
}

TEST_F(RosCameraFileTest, WithP_NothingElseOfTheLensMatters) {
  const std::string text = Replaced(Distorted(kProjection), "camera_matrix", "matrix");
  EXPECT_EQ(Read(Replaced(text, "0.1, -0.2", "nan, wide"), true).camera.fx_px, 570.5F);
}

TEST_F(RosCameraFileTest, RightEyeOfAPair_IsACameraLikeTheLeftOne) {
  // Calibrated in millimetres: the baseline is as long as that.
  const posix::CameraDescription right =
      Read(Distorted("[570.5, 0, 319.5, -171150, 0, 571, 239.5, 3, 0, 0, 1, 0]"), true);
  EXPECT_EQ(right.camera.fx_px, 570.5F);
  EXPECT_EQ(right.camera.cx_px, 319.5F);
}

TEST_F(RosCameraFileTest, PThatIsNone_IsRefusedWithItsLine) {
  for (const char* wrong : {
           "[570.5, 0, 319.5, 0, 571, 239.5, 0, 0, 1]",            // a camera_matrix
           "[0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]",                 // never filled in
           "[-570.5, 0, 319.5, 0, 0, 571, 239.5, 0, 0, 0, 1, 0]",  // mirrored
           "[570.5, 0, 319.5, 0, 0, 2e5, 239.5, 0, 0, 0, 1, 0]",   // no lens
           "[570.5, 2, 319.5, 0, 0, 571, 239.5, 0, 0, 0, 1, 0]",   // skewed
           "[570.5, 0, 319.5, 0, 0, 571, 239.5, 0, 0, 0, 0, 1]",   // third column and fourth
           "[570.5, 0, 319.5, 0, 0, 571, 239.5, 0, 0, 0, 2, 0]",   // not to scale
           "[]",
       }) {
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "camera.yaml:18: projection_matrix is not fx 0 cx",
                        ProjectionRefusal(wrong));
  }
  for (const char* wrong : {"nan", ".nan", ".inf", "1e10", "wide"}) {
    EXPECT_PRED_FORMAT2(
        ::testing::IsSubstring, "camera.yaml:20: projection_matrix is not a number",
        ProjectionRefusal("[570.5, 0, " + std::string(wrong) + ", 0, 0, 571, 1, 0, 0, 0, 1, 0]"));
  }
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "projection_matrix holds no list",
                      ProjectionRefusal("570.5"));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring,
                      "camera.yaml:18: projection_matrix is of no camera with 640x480",
                      ProjectionRefusal("[570.5, 0, 99999, 0, 0, 571, 239.5, 0, 0, 0, 1, 0]"));
  EXPECT_PRED_FORMAT2(
      ::testing::IsSubstring, "projection_matrix is missing",
      CameraFileFixture::Refusal(Replaced(kRectified, "projection_matrix", "matrix"), true));
}

TEST_F(RosCameraFileTest, WhatIsMissing_IsNamed) {
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "image_width is missing",
                      Refusal("image_width: 640\n", ""));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "camera_matrix is missing",
                      Refusal("camera_matrix", "matrix"));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "data is missing",
                      Refusal("  data: [570.5, 0, 319.5, 0, 571, 239.5, 0, 0, 1]\n", ""));
}

TEST_F(RosCameraFileTest, NumbersOutOfRange_AreRefusedWithTheirLine) {
  for (const char* wrong : {"0", "-640", "nan", "1e9", "wide", "[640]"}) {
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "camera.yaml:1: image_width is not a number from",
                        Refusal("640", wrong));
  }
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "camera.yaml:1: image_width is not whole",
                      Refusal("640", "640.5"));
  for (const char* wrong : {"[570.5, 0, 319.5]", "[570.5, 3, 319.5, 0, 571, 239.5, 0, 0, 1]",
                            "[0, 0, 319.5, 0, 571, 239.5, 0, 0, 1]"}) {
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "camera_matrix is not fx 0 cx",
                        Refusal("[570.5, 0, 319.5, 0, 571, 239.5, 0, 0, 1]", wrong));
  }
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "camera_matrix is not a number",
                      Refusal("571, 239.5, 0, 0, 1]", "nan, 239.5, 0, 0, 1]"));
}

TEST_F(RosCameraFileTest, TextThatIsNoYaml_IsRefusedWithItsLine) {
  EXPECT_PRED_FORMAT2(::testing::IsSubstring,
                      "camera.yaml:", RefusalOf([&] { (void)Read("a: [1, 2\nb: }"); }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "image_width is missing",
                      RefusalOf([&] { (void)Read(""); }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "image_width is missing",
                      RefusalOf([&] { (void)Read("[1, 2]"); }));
}

}  // namespace
}  // namespace disflow::apps
