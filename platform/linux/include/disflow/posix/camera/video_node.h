// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace disflow::posix {

/// A device of the kernel's video4linux class, as sysfs describes it.
struct VideoNode {
  std::string path;  ///< E.g. "/dev/video0"; may change when the device is plugged in again.
  std::string name;
  int index = 0;    ///< Among the nodes of one device.
  std::string bus;  ///< Where in the system: sysfs path of the device or USB interface.
  bool is_usb = false;
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::string serial;     ///< Often empty or the same for all units of a cheap camera.
  std::string interface;  ///< USB interface, e.g. "1.0".

  /// The same stream of the same device, though it may have been plugged in anew: by serial
  /// number, by port if it has none.
  [[nodiscard]] bool IsSameDevice(const VideoNode& other) const;
};

/// All nodes, by number.
/// @param sys_root, dev_root Where sysfs and devices are mounted.
[[nodiscard]] std::vector<VideoNode> ListVideoNodes(const std::string& sys_root = "/sys",
                                                    const std::string& dev_root = "/dev");

/// The node behind a path, which may be a symbolic link such as those of /dev/v4l/by-id.
/// @return Nothing if sysfs knows no such device.
[[nodiscard]] std::optional<VideoNode> FindVideoNode(const std::string& path,
                                                     const std::vector<VideoNode>& nodes);

}  // namespace disflow::posix
