// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "disflow/posix/shown_text.h"

namespace disflow::posix {

/// Names of topics for a message to people: as many as it has room for.
class TopicNames {
 public:
  void Add(std::string_view name) {
    constexpr std::size_t kMost = 64;
    constexpr std::size_t kLongest = 64;
    if (names_.size() < kMost) names_.insert(ShownText(name, kLongest));
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
  std::set<std::string> names_;
};

}  // namespace disflow::posix
