// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "camera_messages.h"
#include "disflow/posix/shown_text.h"

namespace disflow::posix {

/// Names of topics: for a message to people as many as it has room for, and of a camera's with
/// their types. No file makes it take more memory than some kilobytes.
class TopicNames {
 public:
  void Add(std::string_view name, std::string_view type) {
    constexpr std::size_t kLongestShown = 64;
    constexpr std::size_t kLongest = 255;
    if (names_.size() < kMost) names_.insert(ShownText(name, kLongestShown));
    const bool is_camera = IsSensorType(type, "Image") || IsSensorType(type, "CompressedImage") ||
                           IsSensorType(type, "CameraInfo");
    if (is_camera && name.size() <= kLongest && camera_types_.size() < kMost)
      camera_types_.emplace(name, type);
  }
  /// Those of another file.
  void Add(const TopicNames& others) {
    for (const std::string& name : others.names_)
      if (names_.size() < kMost) names_.insert(name);
    for (const auto& [name, type] : others.camera_types_)
      if (camera_types_.size() < kMost) camera_types_.emplace(name, type);
  }
  /// Types of topics that are of a camera, by their names.
  [[nodiscard]] const std::map<std::string, std::string>& camera_types() const noexcept {
    return camera_types_;
  }
  /// @return Those that carry a camera first: the message is cut.
  [[nodiscard]] std::string List() const {
    std::string cameras;
    std::string others;
    for (const std::string& name : names_) {
      const bool is_camera =
          name.find("depth") != std::string::npos || name.find("camera") != std::string::npos;
      (is_camera ? cameras : others).append(" ").append(name);
    }
    return cameras + others;
  }

 private:
  static constexpr std::size_t kMost = 64;

  std::set<std::string> names_;
  std::map<std::string, std::string> camera_types_;
};

}  // namespace disflow::posix
