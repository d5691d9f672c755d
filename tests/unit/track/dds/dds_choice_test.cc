// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_choice.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace disflow::apps {
namespace {

namespace ros = posix::ros;

constexpr ImageSize kImage{64, 48};

ros::PointStamped Clicked(std::string& frame) {
  ros::PointStamped clicked{};
  clicked.header.frame_id = frame.data();
  clicked.point = {0.1, -0.2, 0.8};
  return clicked;
}

TEST(DdsChoice, ClickedPoint_IsTakenInTheCamerasFrameAndInTheWorlds) {
  DdsAddress address;
  address.camera_frame = "eye";
  std::string camera = "eye";
  auto choice = ChoiceOf(Clicked(camera), address);
  ASSERT_TRUE(choice.has_value());
  EXPECT_EQ(choice->kind, ObjectChoice::Kind::kPoint);
  EXPECT_EQ(choice->point_m, Vec3(0.1F, -0.2F, 0.8F));
  EXPECT_FALSE(choice->in_world);
  std::string world = "/map";
  EXPECT_FALSE(ChoiceOf(Clicked(world), address).has_value()) << "there is no world";
  address.world_frame = "map";
  choice = ChoiceOf(Clicked(world), address);
  ASSERT_TRUE(choice.has_value());
  EXPECT_TRUE(choice->in_world);
  std::string other = "base_link";
  EXPECT_FALSE(ChoiceOf(Clicked(other), address).has_value());
  EXPECT_FALSE(ChoiceOf(ros::PointStamped{}, address).has_value());
}

TEST(DdsChoice, Request_IsAPixelOrABox) {
  ros::ChooseRequest request{};
  request.u = 32;
  request.v = 12;
  request.reach = 16;
  ObjectChoice choice;
  ASSERT_EQ(ReadChoice(request, kImage, choice), "");
  EXPECT_EQ(choice.kind, ObjectChoice::Kind::kPixel);
  EXPECT_FLOAT_EQ(choice.u, 32.5F / 64.0F);
  EXPECT_FLOAT_EQ(choice.v, 12.5F / 48.0F);
  EXPECT_FLOAT_EQ(choice.reach, 0.25F);
  request.width = 16;
  request.height = 4'000'000'000;
  ASSERT_EQ(ReadChoice(request, kImage, choice), "");
  EXPECT_EQ(choice.kind, ObjectChoice::Kind::kBox);
  EXPECT_FLOAT_EQ(choice.width, 0.25F);
  EXPECT_FLOAT_EQ(choice.height, 1.0F);
}

TEST(DdsChoice, PixelOutsideOfTheImage_IsRefusedWithItsSize) {
  ObjectChoice choice;
  choice.u = 0.125F;
  for (const auto& [u, v] :
       {std::pair<std::uint32_t, std::uint32_t>{64, 0}, {0, 48}, {4294967295U, 0}}) {
    ros::ChooseRequest request{};
    request.u = u;
    request.v = v;
    EXPECT_NE(ReadChoice(request, kImage, choice).find("64 x 48"), std::string::npos);
  }
  EXPECT_EQ(choice.u, 0.125F) << "what is refused changes nothing";
  EXPECT_NE(ReadChoice({}, {}, choice).find("no depth image"), std::string::npos);
}

/// A request with a mask whose rows are `step` apart.
class MaskRequest {
 public:
  explicit MaskRequest(std::uint32_t step = 64) : pixels_(std::size_t{step} * 48, 0) {
    std::fill(pixels_.begin(), pixels_.begin() + step / 2, 255);
    request_.mask.encoding = encoding_.data();
    request_.mask.width = 64;
    request_.mask.height = 48;
    request_.mask.step = step;
    posix::Lend(pixels_, request_.mask.data);
  }
  ros::ChooseRequest& get() { return request_; }
  std::vector<std::uint8_t>& pixels() { return pixels_; }

 private:
  std::string encoding_ = "mono8";
  std::vector<std::uint8_t> pixels_;
  ros::ChooseRequest request_{};
};

TEST(DdsChoice, Mask_IsCopiedRowByRow) {
  MaskRequest request(80);
  ObjectChoice choice;
  ASSERT_EQ(ReadChoice(request.get(), kImage, choice), "");
  EXPECT_EQ(choice.kind, ObjectChoice::Kind::kMask);
  ASSERT_EQ(choice.mask.size(), 64U * 48U);
  EXPECT_EQ(choice.mask[39], 255);
  EXPECT_EQ(choice.mask[40], 0);
  EXPECT_EQ(choice.mask[64], 0);
}

TEST(DdsChoice, MaskThatCannotBe_IsRefusedByWhatIsWrong) {
  const auto refusal = [](MaskRequest& request) {
    ObjectChoice choice;
    return ReadChoice(request.get(), kImage, choice);
  };
  MaskRequest small;
  small.get().mask.height = 47;
  EXPECT_NE(refusal(small).find("as large as the depth image, 64 x 48"), std::string::npos);
  MaskRequest colour;
  std::string rgb = "rgb8";
  colour.get().mask.encoding = rgb.data();
  EXPECT_NE(refusal(colour).find("mono8"), std::string::npos);
  MaskRequest cut;
  --cut.get().mask.data._length;
  EXPECT_NE(refusal(cut).find("too few bytes"), std::string::npos);
  MaskRequest narrow;
  narrow.get().mask.step = 63;
  EXPECT_NE(refusal(narrow).find("too few bytes"), std::string::npos);
  MaskRequest far;
  far.get().mask.step = 4294967295U;
  EXPECT_NE(refusal(far).find("too few bytes"), std::string::npos);
  MaskRequest empty;
  empty.pixels().assign(empty.pixels().size(), 0);
  EXPECT_NE(refusal(empty).find("empty"), std::string::npos);
}

}  // namespace
}  // namespace disflow::apps
