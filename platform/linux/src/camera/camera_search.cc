// SPDX-License-Identifier: BSD-3-Clause
#include "camera_search.h"

#include <vector>

#include "v4l2_format.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

/// A camera has nodes for colour, infrared and metadata too.
bool DeliversFormat(const CameraSearch& search, const VideoNode& node) {
  const int fd = search.kernel.Open(node.path.c_str());
  if (fd < 0) return false;
  const bool delivers = CheckCapabilities(search.kernel, fd, node.path.c_str()).ok() &&
                        OffersFormat(search.kernel, fd, search.address.format);
  search.kernel.Close(fd);
  return delivers;
}

Fault FindBySerial(const CameraSearch& search, const std::vector<VideoNode>& nodes,
                   VideoNode& node) {
  const char* const serial = search.address.serial;
  std::string serials;
  bool found = false;
  for (const VideoNode& candidate : nodes) {
    if (candidate.serial == serial) {
      found = true;
      if (!DeliversFormat(search, candidate)) continue;
      node = candidate;
      return {};
    }
    // The nodes of one camera stand next to each other.
    if (candidate.serial.empty() || serials.ends_with(candidate.serial)) continue;
    serials += (serials.empty() ? "" : ", ") + candidate.serial;
  }
  if (found) {
    return MakeFault(Status::kUnsupported,
                     "serial=%s: none of its nodes delivers depth as asked; see --list-sensors",
                     serial);
  }
  return MakeFault(Status::kNotFound, "serial=%s: no such camera; is it plugged in? There %s%s",
                   serial,
                   serials.empty() ? "is none with a serial number" : "are: ", serials.c_str());
}

}  // namespace

Fault FindCamera(const CameraSearch& search, const std::optional<VideoNode>& known,
                 VideoNode& node) {
  const std::vector<VideoNode> nodes = ListVideoNodes(search.sys_root, search.dev_root);
  // Without sysfs, as in some containers, nothing but the path is known of a device.
  if (known && !known->bus.empty()) {
    for (const VideoNode& candidate : nodes) {
      if (!candidate.IsSameDevice(*known)) continue;
      node = candidate;
      return {};
    }
    return MakeFault(Status::kNotFound, "%s: the camera is not back yet", known->path.c_str());
  }
  if (search.address.serial[0] != '\0') return FindBySerial(search, nodes, node);
  if (const auto found = FindVideoNode(search.address.device, nodes)) {
    node = *found;
    return {};
  }
  node = {};
  node.path = search.address.device;
  return {};
}

}  // namespace disflow::posix
