// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/camera/video_node.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace disflow::posix {
namespace {

namespace fs = std::filesystem;

/// A sysfs of a test's own.
class VideoNodes : public testing::Test {
 protected:
  VideoNodes() : root_(fs::temp_directory_path() / ("disflow_sys_" + std::to_string(::getpid()))) {
    fs::create_directories(root_ / "class/video4linux");
  }
  ~VideoNodes() override { fs::remove_all(root_); }

  static void Write(const fs::path& file, const std::string& text) {
    std::ofstream(file) << text << '\n';
  }
  void AddUsb(const std::string& node, const std::string& port, const std::string& serial) {
    const fs::path device = root_ / "devices" / port;
    const fs::path interface = device / (port + ":1.0");
    fs::create_directories(interface);
    Write(device / "idVendor", "8086");
    Write(device / "idProduct", "0b07");
    if (!serial.empty()) Write(device / "serial", serial);
    AddNode(node, interface);
  }
  void AddNode(const std::string& node, const fs::path& device) {
    const fs::path folder = root_ / "class/video4linux" / node;
    fs::create_directories(folder);
    Write(folder / "name", "Depth Camera");
    Write(folder / "index", "0");
    fs::create_directory_symlink(device, folder / "device");
  }
  std::vector<VideoNode> List() { return ListVideoNodes(root_.string(), "/dev"); }

  fs::path root_;
};

TEST_F(VideoNodes, UsbCamera_IsListedWithItsIdentity) {
  AddUsb("video10", "1-4", "0815");
  AddUsb("video2", "1-3", "");
  fs::create_directories(root_ / "class/video4linux/v4l-subdev0");
  const auto nodes = List();
  ASSERT_EQ(nodes.size(), 2U);
  EXPECT_EQ(nodes[0].path, "/dev/video2");
  EXPECT_EQ(nodes[1].path, "/dev/video10");
  EXPECT_TRUE(nodes[1].is_usb);
  EXPECT_EQ(nodes[1].vendor_id, 0x8086);
  EXPECT_EQ(nodes[1].product_id, 0x0B07);
  EXPECT_EQ(nodes[1].serial, "0815");
  EXPECT_EQ(nodes[1].interface, "1.0");
}

TEST_F(VideoNodes, NoSysfs_IsAnEmptyList) { EXPECT_TRUE(ListVideoNodes("/nowhere").empty()); }

TEST_F(VideoNodes, CameraPluggedInElsewhere_IsTheSameBySerial) {
  AddUsb("video0", "1-4", "0815");
  const VideoNode before = List().at(0);
  fs::remove_all(root_ / "class/video4linux/video0");
  AddUsb("video1", "2-1", "0815");
  EXPECT_TRUE(List().at(0).IsSameDevice(before));
  fs::remove_all(root_ / "class/video4linux/video1");
  AddUsb("video1", "2-2", "0816");
  EXPECT_FALSE(List().at(0).IsSameDevice(before));
}

TEST_F(VideoNodes, CameraWithoutSerial_IsTheSameAtItsPortOnly) {
  AddUsb("video0", "1-4", "");
  const VideoNode before = List().at(0);
  EXPECT_TRUE(List().at(0).IsSameDevice(before));
  fs::remove_all(root_ / "class/video4linux/video0");
  AddUsb("video0", "1-5", "");
  EXPECT_FALSE(List().at(0).IsSameDevice(before));
}

TEST_F(VideoNodes, DeviceThatIsNoUsb_IsKnownByItsPlace) {
  fs::create_directories(root_ / "devices/platform/vivid.0");
  AddNode("video0", root_ / "devices/platform/vivid.0");
  const VideoNode node = List().at(0);
  EXPECT_FALSE(node.is_usb);
  EXPECT_TRUE(node.IsSameDevice(List().at(0)));
  EXPECT_TRUE(FindVideoNode("/dev/video0", List()));
  EXPECT_FALSE(FindVideoNode("/dev/video1", List()));
}

}  // namespace
}  // namespace disflow::posix
