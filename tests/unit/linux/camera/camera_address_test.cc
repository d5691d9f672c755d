// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/camera/camera_address.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace disflow::posix {
namespace {

CameraAddress Parse(std::string_view uri) {
  CameraAddress address;
  const hal::Fault fault = ParseCameraAddress(uri, address);
  EXPECT_TRUE(fault.ok()) << uri << ": " << fault.message;
  return address;
}

std::string Refusal(std::string_view uri) {
  CameraAddress address;
  address.width_px = 77;
  const hal::Fault fault = ParseCameraAddress(uri, address);
  EXPECT_EQ(fault.status, Status::kInvalidUri) << uri;
  EXPECT_EQ(address.width_px, 77) << "a refused address must leave the old one alone";
  return fault.message;
}

TEST(CameraAddress, AllOptionsOfV4l2_AreTaken) {
  const CameraAddress address = Parse(
      "v4l2:/dev/video2?format=Z16&width=640&height=480&fps=29.97&depth_scale=0.001&"
      "intrinsics=cam.toml");
  EXPECT_EQ(address.kind, CameraAddress::Kind::kV4l2);
  EXPECT_STREQ(address.device, "/dev/video2");
  EXPECT_STREQ(address.format->name, "Z16");
  EXPECT_EQ(address.width_px, 640);
  EXPECT_EQ(address.height_px, 480);
  EXPECT_FLOAT_EQ(address.rate_hz, 29.97F);
  EXPECT_FLOAT_EQ(address.unit_m, 0.001F);
  EXPECT_STREQ(address.intrinsics, "cam.toml");
}

TEST(CameraAddress, NothingButADevice_LeavesTheRestOpen) {
  const CameraAddress address = Parse("v4l2:/dev/v4l/by-id/usb-Intel-video-index0");
  EXPECT_EQ(address.format, nullptr);
  EXPECT_EQ(address.width_px, 0);
  EXPECT_FALSE(address.camera.IsValid());
  EXPECT_FALSE(address.rectified);
}

TEST(CameraAddress, WhetherTheDriverRectifies_IsTakenWithAnyIntrinsicsOfAnyCamera) {
  for (const char* start : {"v4l2:/dev/video0?", "v4l2:serial=0123AB&", "libcamera:0?"}) {
    for (const char* intrinsics : {"intrinsics=cam.yaml", "intrinsics=cam.toml", "K=4,4,2,1.5"}) {
      const std::string uri = std::string(start) + intrinsics;
      EXPECT_TRUE(Parse(uri + "&rectified=yes").rectified);
      EXPECT_FALSE(Parse(uri + "&rectified=no").rectified);
    }
  }
}

TEST(CameraAddress, Serial_MayBeFollowedByEitherSeparator) {
  for (const char* uri : {"v4l2:serial=0123AB?fps=30", "v4l2:serial=0123AB&fps=30"}) {
    const CameraAddress address = Parse(uri);
    EXPECT_STREQ(address.serial, "0123AB");
    EXPECT_STREQ(address.device, "");
    EXPECT_FLOAT_EQ(address.rate_hz, 30.0F);
  }
}

TEST(CameraAddress, Libcamera_HasFormatsOfItsOwn) {
  const CameraAddress address = Parse("libcamera:0?format=R12&K=600,601,320,240");
  EXPECT_EQ(address.kind, CameraAddress::Kind::kLibcamera);
  EXPECT_STREQ(address.device, "0");
  EXPECT_STREQ(address.format->name, "R12");
  EXPECT_FLOAT_EQ(address.camera.fy_px, 601.0F);
  EXPECT_NE(Refusal("libcamera:0?format=Z16").find("R12"), std::string::npos);
}

TEST(CameraAddress, WrongPart_IsNamedWithWhatIsAllowed) {
  const std::pair<const char*, const char*> cases[] = {
      {"v4l2:", "/dev/video0"},
      {"v4l2:video0", "video0"},
      {"v4l2:serial=", "serial"},
      {"usb:1", "v4l2:"},
      {"libcamera:", "--list-sensors"},
      {"v4l2:/dev/video0?format=YUYV", "Y16_BE"},
      {"v4l2:/dev/video0?width=0&height=1", "from 1 to 8192"},
      {"v4l2:/dev/video0?width=640", "height"},
      {"v4l2:/dev/video0?fps=nan", "fps=nan"},
      {"v4l2:/dev/video0?fps=1e99", "fps=1e99"},
      {"v4l2:/dev/video0?depth_scale=2", "depth_scale=2"},
      {"v4l2:/dev/video0?fps=30&fps=30", "fps is given twice"},
      {"v4l2:/dev/video0?K=1,2,3", "fx,fy,cx,cy"},
      {"v4l2:/dev/video0?K=1,2,3,4,5", "fx,fy,cx,cy"},
      {"v4l2:/dev/video0?K=0,2,3,4", "fx,fy,cx,cy"},
      {"v4l2:/dev/video0?K=1,2,3,4&intrinsics=a", "twice"},
      {"v4l2:/dev/video0?colour=red", "colour=red"},
      {"v4l2:/dev/video0?fps", "'fps'"},
      {"v4l2:/dev/video0?intrinsics=", "intrinsics"},
      {"v4l2:/dev/video0?rectified=1", "rectified=1 is neither yes nor no"},
      {"v4l2:/dev/video0?rectified=", "neither yes nor no"},
      {"v4l2:/dev/video0?rectified=no&rectified=yes", "rectified is given twice"},
  };
  for (const auto& [uri, word] : cases) {
    EXPECT_NE(Refusal(uri).find(word), std::string::npos) << uri << " said: " << Refusal(uri);
  }
}

TEST(CameraAddress, TextsThatDoNotFit_AreRefused) {
  EXPECT_NE(Refusal("v4l2:/" + std::string(256, 'a')).find("longer than 255"), std::string::npos);
  EXPECT_NE(Refusal("v4l2:serial=" + std::string(128, 'a')).find("127"), std::string::npos);
  using std::string_literals::operator""s;
  Refusal("v4l2:/dev/video0\0?fps=30"s);
}

TEST(CameraAddress, AnyBytes_GiveEitherAnAddressOrAReason) {
  std::mt19937 random(1);
  const std::string seed = "v4l2:serial=12&format=Z16&width=4&height=3&K=1,2,3,4&fps=30";
  for (int i = 0; i < 20000; ++i) {
    std::string uri = seed;
    for (auto k = random() % 6 + 1; k > 0; --k) {
      uri[random() % uri.size()] = static_cast<char>(random() % 256);
    }
    uri.resize(random() % (uri.size() + 1));
    CameraAddress address;
    const hal::Fault fault = ParseCameraAddress(uri, address);
    ASSERT_EQ(fault.ok(), fault.message[0] == '\0') << uri;
  }
}

}  // namespace
}  // namespace disflow::posix
