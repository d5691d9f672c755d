// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/camera/video_node.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

namespace disflow::posix {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "video";

/// First line of a sysfs file; empty if it is not there.
std::string ReadAttribute(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

int NumberOf(std::string_view text, int base) {
  int number = -1;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return error == std::errc{} && stop == text.data() + text.size() ? number : -1;
}

int NodeNumber(const std::string& path) {
  const std::string name = fs::path(path).filename().string();
  return name.starts_with(kPrefix) ? NumberOf(std::string_view(name).substr(kPrefix.size()), 10)
                                   : -1;
}

void ReadUsb(const fs::path& interface, VideoNode& node) {
  const fs::path device = interface.parent_path();
  const int vendor = NumberOf(ReadAttribute(device / "idVendor"), 16);
  const int product = NumberOf(ReadAttribute(device / "idProduct"), 16);
  if (vendor < 0 || product < 0) return;
  node.is_usb = true;
  node.vendor_id = static_cast<std::uint16_t>(vendor);
  node.product_id = static_cast<std::uint16_t>(product);
  node.serial = ReadAttribute(device / "serial");
  const std::string name = interface.filename().string();  // "1-4:1.0"
  node.interface = name.substr(std::min(name.find(':') + 1, name.size()));
}

}  // namespace

bool VideoNode::IsSameDevice(const VideoNode& other) const {
  if (is_usb != other.is_usb || index != other.index || name != other.name) return false;
  if (is_usb && (vendor_id != other.vendor_id || product_id != other.product_id ||
                 interface != other.interface || serial != other.serial)) {
    return false;
  }
  return (is_usb && !serial.empty()) || bus == other.bus;
}

std::vector<VideoNode> ListVideoNodes(const std::string& sys_root, const std::string& dev_root) {
  std::vector<VideoNode> nodes;
  std::error_code error;
  const fs::path folder = fs::path(sys_root) / "class" / "video4linux";
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& link = entry->path();
    if (NodeNumber(link.string()) < 0) continue;  // v4l-subdev, vbi, radio
    VideoNode node;
    node.path = (fs::path(dev_root) / link.filename()).string();
    node.name = ReadAttribute(link / "name");
    node.index = std::max(NumberOf(ReadAttribute(link / "index"), 10), 0);
    std::error_code ignored;  // a device that is just going away has no target
    const fs::path device = fs::canonical(link / "device", ignored);
    node.bus = device.string();
    ReadUsb(device, node);
    nodes.push_back(std::move(node));
  }
  std::sort(nodes.begin(), nodes.end(), [](const VideoNode& a, const VideoNode& b) {
    return NodeNumber(a.path) < NodeNumber(b.path);
  });
  return nodes;
}

std::optional<VideoNode> FindVideoNode(const std::string& path,
                                       const std::vector<VideoNode>& nodes) {
  std::error_code error;
  const std::string target = fs::canonical(path, error).string();
  for (const VideoNode& node : nodes) {
    if (node.path == path || (!error && node.path == target)) return node;
  }
  return std::nullopt;
}

}  // namespace disflow::posix
