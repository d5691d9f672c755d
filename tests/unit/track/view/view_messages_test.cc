// SPDX-License-Identifier: BSD-3-Clause
#include "view/view_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "disflow/config_fields.h"
#include "view/view_texts.h"

namespace disflow::apps {
namespace {

template <class Value>
Value At(const ViewBytes& bytes, std::size_t offset) {
  Value value{};
  if (offset + sizeof(Value) > bytes.size()) {
    ADD_FAILURE() << "the message ends before byte " << offset;
    return value;
  }
  std::memcpy(&value, bytes.data() + offset, sizeof(Value));
  return value;
}

TEST(ViewMessages, Frames_StandWhereTheDocumentSays) {
  std::vector<FrameResult> results(2);
  FrameResult& result = results[1];
  result.frame = 7;
  result.total_ns = 2'500'000;
  result.estimate.stamp_ns = 1'500'000'000;
  result.estimate.state = TrackingState::kDegraded;
  result.estimate.status = Status::kRegistrationFailed;
  result.estimate.quality = 42;
  result.estimate.reset_counter = 3;
  result.estimate.T_co = PoseCameraFromObject(Mat3::Identity(), Vec3(1.0F, 2.0F, 3.0F));
  result.estimate.twist.angular_rps = Vec3(0.1F, 0.2F, 0.3F);
  result.estimate.pose_covariance(5, 5) = 0.25F;
  result.estimate.stage_ns[5] = 1'000'000;
  result.estimate.inliers = 300;
  result.estimate.rms_m = 0.001F;
  const ViewBytes bytes = EncodeFrames(2, results);
  ASSERT_EQ(bytes.size(), 8U + 2U * kFrameRecordBytes);
  EXPECT_EQ(At<std::uint8_t>(bytes, 0), 3);
  EXPECT_EQ(At<std::uint8_t>(bytes, 1), 2);
  EXPECT_EQ(At<std::uint16_t>(bytes, 2), 160);
  EXPECT_EQ(At<std::uint32_t>(bytes, 4), 2U);
  const std::size_t at = 8 + 160;
  EXPECT_EQ(At<double>(bytes, at), 1.5);
  EXPECT_EQ(At<std::uint32_t>(bytes, at + 8), 7U);
  EXPECT_EQ(At<std::uint8_t>(bytes, at + 12), 2);
  EXPECT_EQ(At<std::uint8_t>(bytes, at + 13), 17);
  EXPECT_EQ(At<std::uint8_t>(bytes, at + 14), 42);
  EXPECT_EQ(At<std::uint8_t>(bytes, at + 15), 3);
  EXPECT_EQ(At<float>(bytes, at + 24), 3.0F);
  EXPECT_EQ(At<float>(bytes, at + 28), 1.0F);
  EXPECT_EQ(At<float>(bytes, at + 60), 0.2F);
  EXPECT_EQ(At<float>(bytes, at + 88), 0.5F);
  EXPECT_EQ(At<float>(bytes, at + 136), 1.0F);
  EXPECT_EQ(At<float>(bytes, at + 140), 2.5F);
  EXPECT_EQ(At<std::uint16_t>(bytes, at + 146), 300);
  EXPECT_EQ(At<float>(bytes, at + 156), 0.001F);
}

TEST(ViewMessages, RefusedFrame_HasNeitherPoseNorDeviations) {
  FrameResult result;
  result.estimate.status = Status::kStampNotIncreasing;
  result.estimate.quality = 42;
  result.estimate.pose_covariance = Mat6::Identity();
  const ViewBytes bytes = EncodeFrames(0, {&result, 1});
  EXPECT_EQ(At<std::uint8_t>(bytes, 8 + 13), 9);
  EXPECT_EQ(At<std::uint8_t>(bytes, 8 + 14), 0);
  for (std::size_t at = 16; at < 116; at += sizeof(float)) {
    EXPECT_TRUE(std::isnan(At<float>(bytes, 8 + at))) << "at " << at;
  }
}

TEST(ViewMessages, Surface_KeepsPlacesToATenThousandthOfItsSize) {
  SurfaceMesh mesh;
  const SurfaceVertex a = {Vec3(0.0F, 0.0F, 0.0F), Vec3(0.0F, 0.0F, 1.0F), 0.001F};
  const SurfaceVertex b = {Vec3(0.1F, 0.0F, 0.0F), Vec3(0.0F, 1.0F, 0.0F), 0.002F};
  const SurfaceVertex c = {Vec3(0.03F, 0.2F, 0.0F), Vec3(-1.0F, 0.0F, 0.0F), 0.004F};
  mesh.OnTriangle(a, b, c);
  const ViewBytes bytes = EncodeSurface(0, 2'000'000'000, mesh);
  ASSERT_EQ(bytes.size(), 56U + 3U * 12U + 3U * 2U);
  EXPECT_EQ(At<std::uint16_t>(bytes, 2), 2);
  EXPECT_EQ(At<std::uint32_t>(bytes, 4), 3U);
  EXPECT_EQ(At<std::uint32_t>(bytes, 8), 1U);
  EXPECT_EQ(At<double>(bytes, 24), 2.0);
  const float low_m = At<float>(bytes, 32);
  const float size_m = At<float>(bytes, 44);
  const float x_m =
      low_m + size_m * static_cast<float>(At<std::uint16_t>(bytes, 56 + 16)) / 65535.0F;
  EXPECT_NEAR(x_m, 0.03F, 1e-5F);
  const float largest_m = At<float>(bytes, 20);
  EXPECT_NEAR(largest_m * static_cast<float>(At<std::uint16_t>(bytes, 56 + 8 + 6)) / 65535.0F,
              0.002F, 1e-6F);
  EXPECT_EQ(At<std::int8_t>(bytes, 56 + 24 + 8), -127);
  EXPECT_EQ(At<std::uint16_t>(bytes, 56 + 36 + 4), 2);
}

TEST(ViewMessages, EmptySurface_IsAMessageWithoutTriangles) {
  const ViewBytes bytes = EncodeSurface(0, 0, SurfaceMesh());
  ASSERT_EQ(bytes.size(), 56U);
  EXPECT_EQ(At<std::uint32_t>(bytes, 4), 0U);
}

class FlowMessage : public testing::Test {
 protected:
  void Add(const FlowSample& sample) { static_cast<FlowSink&>(flow_).OnSample(sample); }
  FlowCloud flow_;
};

TEST_F(FlowMessage, ValuesOutOfRange_AreClampedAndUnknownDistancesMarked) {
  FlowSample sample;
  sample.position_m = Vec3(1.0F, -100.0F, 0.5F);
  sample.flow_mps = Vec3(0.25F, 0.0F, 100.0F);
  Add(sample);
  const ViewBytes bytes = EncodeFlow(1, 0, flow_);
  ASSERT_EQ(bytes.size(), 16U + 16U);
  EXPECT_EQ(At<std::int16_t>(bytes, 16), 4000);
  EXPECT_EQ(At<std::int16_t>(bytes, 18), -32767);
  EXPECT_EQ(At<std::int16_t>(bytes, 22), 1000);
  EXPECT_EQ(At<std::int16_t>(bytes, 26), 32767);
  EXPECT_EQ(At<std::int16_t>(bytes, 28), std::numeric_limits<std::int16_t>::min());
}

TEST_F(FlowMessage, ManySamples_AreThinnedEvenly) {
  for (int i = 0; i < 2048; ++i) Add(FlowSample{});
  const ViewBytes bytes = EncodeFlow(0, 0, flow_);
  const auto shown = At<std::uint32_t>(bytes, 4);
  EXPECT_LE(shown, kShownFlowSamples);
  EXPECT_GT(shown, kShownFlowSamples / 2);
  EXPECT_EQ(bytes.size(), 16U + 16U * shown);
}

TEST(ViewMessages, DepthWithMask_HasALevelAndABitPerPixel) {
  constexpr int kWidth_px = 20;
  constexpr int kHeight_px = 10;
  std::vector<std::uint16_t> depth(kWidth_px * kHeight_px, 1000);
  depth[0] = 0;
  depth[1] = 2000;
  DepthFrame frame;
  frame.depth = {depth.data(), kWidth_px, kHeight_px, 2 * kWidth_px, DepthFormat::kUint16, 0.001F};
  struct {
    [[nodiscard]] int width_px() const { return kWidth_px; }
    [[nodiscard]] int height_px() const { return kHeight_px; }
    [[nodiscard]] bool Test(int u, int v) const { return u == 3 && v == 0; }
  } mask;
  DepthPicture picture;
  picture.Take(frame, mask);
  const ViewBytes bytes = EncodeDepth(0, picture);
  ASSERT_EQ(bytes.size(), 12U + 200U + 25U);
  EXPECT_EQ(At<std::uint16_t>(bytes, 8), 1000);
  EXPECT_EQ(At<std::uint16_t>(bytes, 10), 2000);
  EXPECT_EQ(bytes[12], 0);
  EXPECT_EQ(bytes[13], 255);
  EXPECT_EQ(bytes[14], 1);
  EXPECT_EQ(bytes[12 + 200], 1U << 3U);
}

TEST(ViewTexts, NamesThatAreNoUtf8_StayJson) {
  const std::vector<std::string> names = {"bo\"x", "\xff\xfe"};
  const std::string text = DescribeProgram("1", names);
  EXPECT_NE(text.find("bo\\\"x"), std::string::npos);
  EXPECT_EQ(text.find('\xff'), std::string::npos);
}

TEST(ViewMessages, Choice_IsAPlaceOrABoxInSharesOfThePicture) {
  // What, object, nothing, then five shares.
  std::vector<std::uint8_t> command = {4, 1, 0, 0, 0x00, 0x80, 0xFF, 0xFF, 0x66, 0x06, 0, 0, 0, 0};
  auto choice = DecodeChoice(command);
  ASSERT_TRUE(choice.has_value());
  EXPECT_EQ(choice->kind, ObjectChoice::Kind::kPixel);
  EXPECT_NEAR(choice->u, 0.5F, 1e-5F);
  EXPECT_EQ(choice->v, 1.0F);
  EXPECT_NEAR(choice->reach, 0.025F, 1e-5F);
  command[11] = 0x40;
  command[13] = 0x20;
  choice = DecodeChoice(command);
  ASSERT_TRUE(choice.has_value());
  EXPECT_EQ(choice->kind, ObjectChoice::Kind::kBox);
  EXPECT_NEAR(choice->width, 0.25F, 1e-5F);
  EXPECT_NEAR(choice->height, 0.125F, 1e-5F);
  command.pop_back();
  EXPECT_FALSE(DecodeChoice(command).has_value());
}

TEST(ViewMessages, Setting_IsANumberAndAValue) {
  std::vector<std::uint8_t> command = {5, 1, 0x2C, 0x01, 0, 0, 0, 0, 0, 0, 0xE0, 0x3F, 0, 0};
  const auto setting = DecodeSetting(command);
  ASSERT_TRUE(setting.has_value());
  EXPECT_EQ(setting->number, 300);
  EXPECT_EQ(setting->value, 0.5);
  command.pop_back();
  EXPECT_FALSE(DecodeSetting(command).has_value());
}

TEST(ViewTexts, SettingsThatMayChange_AreTheOnlyOnesAndHaveTheirNumbers) {
  Config config;
  config.registration.iterations = 11;
  const auto json = nlohmann::json::parse(DescribeRunningSettings(config));
  std::size_t number = 0;
  std::size_t listed = 0;
  VisitFields(config, [&](const auto& field) {
    const std::size_t own = number++;
    if (!field.at_run_time) return;
    const auto& setting = json.at("settings").at(listed++);
    EXPECT_EQ(setting.at("number"), own) << field.name;
    EXPECT_EQ(setting.at("name"), field.name);
    EXPECT_EQ(setting.at("value"), field.value);
    EXPECT_EQ(setting.at("max"), field.max);
  });
  EXPECT_EQ(json.at("settings").size(), listed);
}

}  // namespace
}  // namespace disflow::apps
