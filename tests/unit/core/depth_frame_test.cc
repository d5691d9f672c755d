// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/depth_frame.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace disflow {
namespace {

constexpr int kMaxWidth_px = 8;
constexpr int kMaxHeight_px = 6;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class CheckFrameTest : public ::testing::Test {
 protected:
  CheckFrameTest() {
    frame_.depth = {depth_.data(), 8, 6, 16, DepthFormat::kUint16, 0.001F};
    frame_.camera = {600.0F, 600.0F, 4.0F, 3.0F};
    frame_.stamp_ns = 1;
  }
  [[nodiscard]] Status Check() const { return CheckFrame(frame_, kMaxWidth_px, kMaxHeight_px); }
  void GiveMask() { frame_.mask = {mask_.data(), 8, 6, 8}; }

  DepthFrame frame_;

 private:
  std::array<std::uint16_t, 48> depth_{};
  std::array<std::uint8_t, 48> mask_{};
};

TEST_F(CheckFrameTest, SoundFrame_IsAccepted) {
  EXPECT_EQ(Check(), Status::kOk);
  GiveMask();
  EXPECT_EQ(Check(), Status::kOk);
}

TEST_F(CheckFrameTest, PaddedRows_AreAccepted) {
  frame_.depth.width_px = 5;
  EXPECT_EQ(Check(), Status::kOk);
}

TEST_F(CheckFrameTest, NoPixels_IsInvalidSize) {
  frame_.depth.data = nullptr;
  EXPECT_EQ(Check(), Status::kInvalidImageSize);
}

TEST_F(CheckFrameTest, ZeroOrNegativeSize_IsInvalidSize) {
  for (const int bad : {0, -1, std::numeric_limits<int>::min()}) {
    DepthFrame sound = frame_;
    frame_.depth.width_px = bad;
    EXPECT_EQ(Check(), Status::kInvalidImageSize) << bad;
    frame_ = sound;
    frame_.depth.height_px = bad;
    EXPECT_EQ(Check(), Status::kInvalidImageSize) << bad;
    frame_ = sound;
  }
}

TEST_F(CheckFrameTest, LargerThanTheProfile_IsTooLarge) {
  frame_.depth.width_px = kMaxWidth_px + 1;
  frame_.depth.stride_bytes = 100;
  EXPECT_EQ(Check(), Status::kImageTooLarge);
  frame_.depth.width_px = kMaxWidth_px;
  frame_.depth.height_px = kMaxHeight_px + 1;
  EXPECT_EQ(Check(), Status::kImageTooLarge);
  frame_.depth.height_px = std::numeric_limits<int>::max();
  EXPECT_EQ(Check(), Status::kImageTooLarge);
}

TEST_F(CheckFrameTest, StrideShorterThanARow_IsInvalidSize) {
  for (const std::ptrdiff_t bad : {15, 0, -16}) {
    frame_.depth.stride_bytes = bad;
    EXPECT_EQ(Check(), Status::kInvalidImageSize) << bad;
  }
  frame_.depth.stride_bytes = 16;
  frame_.depth.format = DepthFormat::kFloat32;  // needs 32
  EXPECT_EQ(Check(), Status::kInvalidImageSize);
}

TEST_F(CheckFrameTest, UnitThatIsNoLength_IsRefusedForRawUnitsOnly) {
  for (const float bad : {0.0F, -0.001F, kNan, kInfinity}) {
    frame_.depth.unit_m = bad;
    EXPECT_NE(Check(), Status::kOk) << bad;
  }
  frame_.depth.format = DepthFormat::kFloat32;
  frame_.depth.stride_bytes = 32;
  EXPECT_EQ(Check(), Status::kOk);
}

TEST_F(CheckFrameTest, BadIntrinsics_AreNamed) {
  for (const float bad : {0.0F, -600.0F, kNan, kInfinity}) {
    frame_.camera.fx_px = bad;
    EXPECT_EQ(Check(), Status::kInvalidIntrinsics) << bad;
  }
}

TEST_F(CheckFrameTest, MaskOfAnotherSize_IsNamed) {
  GiveMask();
  frame_.mask.width_px = 7;
  EXPECT_EQ(Check(), Status::kMaskSizeMismatch);
  GiveMask();
  frame_.mask.height_px = 5;
  EXPECT_EQ(Check(), Status::kMaskSizeMismatch);
  GiveMask();
  frame_.mask.stride_bytes = 7;
  EXPECT_EQ(Check(), Status::kMaskSizeMismatch);
}

TEST_F(CheckFrameTest, NoMask_IgnoresItsSize) {
  frame_.mask = {nullptr, 1, 1, 0};
  EXPECT_EQ(Check(), Status::kOk);
}

TEST_F(CheckFrameTest, CameraPoseThatIsNotRigid_IsNamed) {
  using Pose = Transform<World, Camera>;
  frame_.has_T_wc = true;
  EXPECT_EQ(Check(), Status::kOk);
  const Vec3 origin = Vec3::Zero();
  frame_.T_wc = Pose(Mat3(1.1F * Mat3::Identity()), origin);
  EXPECT_EQ(Check(), Status::kInvalidTransform) << "scaled";
  frame_.T_wc = Pose(Mat3(-Mat3::Identity()), origin);
  EXPECT_EQ(Check(), Status::kInvalidTransform) << "mirrored";
  frame_.T_wc = Pose(Mat3(Mat3::Zero()), origin);
  EXPECT_EQ(Check(), Status::kInvalidTransform) << "all zero";
  frame_.T_wc = Pose(Mat3(Mat3::Identity()), Vec3(0.0F, kNan, 0.0F));
  EXPECT_EQ(Check(), Status::kInvalidTransform) << "not finite";
}

TEST_F(CheckFrameTest, CameraPoseThatIsNotGiven_IsNotJudged) {
  frame_.T_wc = Transform<World, Camera>(Mat3(Mat3::Zero()), Vec3(Vec3::Zero()));
  EXPECT_EQ(Check(), Status::kOk);
}

}  // namespace
}  // namespace disflow
