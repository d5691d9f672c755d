// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/ros/ros_camera_info.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace disflow::posix {
namespace {

using hal::Fault;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A camera whose K and P differ, as those of one with distortion do.
struct Calibration {
  std::array<double, 5> d{};
  std::array<double, 9> k{600, 0, 320, 0, 610, 240, 0, 0, 1};
  std::array<double, 12> p{580, 0, 318, 0, 0, 590, 238, 0, 0, 0, 1, 0};

  [[nodiscard]] RosCameraInfo Info() const {
    return {.width_px = 640,
            .height_px = 480,
            .distortion_model = "plumb_bob",
            .d = d,
            .k = std::span<const double, 9>(k),
            .p = std::span<const double, 12>(p)};
  }
};

RosIntrinsics Read(const RosCameraInfo& info, bool rectified) {
  RosIntrinsics intrinsics;
  const Fault fault = ReadCameraInfo(info, rectified, intrinsics);
  EXPECT_TRUE(fault.ok()) << fault.message;
  return intrinsics;
}

std::string Refusal(const RosCameraInfo& info, bool rectified, Status status) {
  RosIntrinsics intrinsics;
  const Fault fault = ReadCameraInfo(info, rectified, intrinsics);
  EXPECT_EQ(fault.status, status) << fault.message;
  EXPECT_EQ(intrinsics.width_px, 0U) << "it is left alone";
  return fault.message;
}

void ExpectCamera(const RosIntrinsics& intrinsics, float fx, float fy, float cx, float cy) {
  EXPECT_FLOAT_EQ(intrinsics.camera.fx_px, fx);
  EXPECT_FLOAT_EQ(intrinsics.camera.fy_px, fy);
  EXPECT_FLOAT_EQ(intrinsics.camera.cx_px, cx);
  EXPECT_FLOAT_EQ(intrinsics.camera.cy_px, cy);
}

TEST(RosCameraInfo, RectifiedImages_HaveTheIntrinsicsOfP) {
  Calibration calibration;
  calibration.d = {-0.1, 0.02, 0.0, 0.0, 0.0};  // which are the raw images'
  const RosIntrinsics intrinsics = Read(calibration.Info(), true);
  ExpectCamera(intrinsics, 580, 590, 318, 238);
  EXPECT_EQ(intrinsics.width_px, 640U);
  EXPECT_EQ(intrinsics.height_px, 480U);
}

TEST(RosCameraInfo, ImagesOfALensThatDoesNotDistort_HaveTheIntrinsicsOfK) {
  const Calibration calibration;
  ExpectCamera(Read(calibration.Info(), false), 600, 610, 320, 240);
}

TEST(RosCameraInfo, DistortionOfImagesThatAreNotRectified_IsRefusedAndSaysWhatToDo) {
  for (const double coefficient : {-0.1, 1e-3, kNan}) {
    Calibration calibration;
    calibration.d[4] = coefficient;
    const std::string said = Refusal(calibration.Info(), false, Status::kUnsupported);
    EXPECT_NE(said.find("subscribe to the rectified topic"), std::string::npos) << said;
  }
  const Calibration fisheye;
  RosCameraInfo info = fisheye.Info();
  info.distortion_model = "equidistant";  // no pinhole, also with coefficients of 0
  EXPECT_NE(Refusal(info, false, Status::kUnsupported).find("equidistant"), std::string::npos);
  EXPECT_TRUE(Read(info, true).camera.IsValid());
}

TEST(RosCameraInfo, PThatWasNeverFilledIn_IsReplacedByKOnlyWithoutDistortion) {
  Calibration calibration;
  calibration.p = {};
  ExpectCamera(Read(calibration.Info(), true), 600, 610, 320, 240);
  calibration.d[0] = 0.1;
  (void)Refusal(calibration.Info(), true, Status::kInvalidIntrinsics);
}

TEST(RosCameraInfo, BinningAndRegion_MoveAndScaleAsRosDoesIt) {
  const Calibration calibration;
  RosCameraInfo info = calibration.Info();
  info.binning_x = 2;
  info.binning_y = 4;
  info.roi_x_px = 100;
  info.roi_y_px = 40;
  info.roi_width_px = 320;
  info.roi_height_px = 240;
  const RosIntrinsics intrinsics = Read(info, false);
  EXPECT_EQ(intrinsics.width_px, 160U);
  EXPECT_EQ(intrinsics.height_px, 60U);
  ExpectCamera(intrinsics, 300, 152.5F, 110, 50);
}

TEST(RosCameraInfo, WhatIsNoCalibration_IsRefused) {
  const Calibration good;
  Calibration none;
  none.k = {};
  EXPECT_NE(Refusal(none.Info(), false, Status::kInvalidIntrinsics).find("calibrate"),
            std::string::npos);
  for (const double value : {kNan, -600.0, 1e30, std::numeric_limits<double>::infinity()}) {
    Calibration wrong;
    wrong.k[0] = value;
    (void)Refusal(wrong.Info(), false, Status::kInvalidIntrinsics);
  }
  Calibration skewed;
  skewed.k[1] = 2.0;
  (void)Refusal(skewed.Info(), false, Status::kUnsupported);
  RosCameraInfo outside = good.Info();
  outside.roi_x_px = 0xFFFFFFFF;
  outside.roi_width_px = 2;
  outside.roi_height_px = 2;
  (void)Refusal(outside, false, Status::kUnsupported);
}

TEST(RosCameraInfo, NamesOfTopics_SayWhatImageTransportMeansByThem) {
  for (const char* topic : {"/camera/depth/image_rect_raw", "/depth/image_rect", "/image_rect",
                            "/camera/depth/image_rect_raw/compressedDepth"})
    EXPECT_TRUE(IsRectifiedTopic(topic)) << topic;
  for (const char* topic :
       {"/camera/depth/image_raw", "/rectangle/image", "/image", "/rect/image_raw/compressedDepth"})
    EXPECT_FALSE(IsRectifiedTopic(topic)) << topic;
  EXPECT_EQ(CameraInfoTopic("/camera/depth/image_rect_raw"), "/camera/depth/camera_info");
  EXPECT_EQ(CameraInfoTopic("/camera/depth/image/compressedDepth"), "/camera/depth/camera_info");
  EXPECT_EQ(CameraInfoTopic("/image"), "/camera_info");
  EXPECT_TRUE(IsCompressedDepthTopic("/image/compressedDepth"));
  EXPECT_FALSE(IsCompressedDepthTopic("/image/compressed"));
}

}  // namespace
}  // namespace disflow::posix
