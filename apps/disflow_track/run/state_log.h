// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "program/console.h"
#include "program/frame_result.h"

namespace disflow::apps {

/// Tells the journal when an object's state changes, with fields that programs read. Does nothing
/// where messages are text for people: they see the state itself. One message a second and object
/// at most; what happened in between is counted in the next.
class StateLog {
 public:
  /// @param names Of the objects, in the order of the results.
  explicit StateLog(std::vector<std::string> names)
      : objects_(names.size()), names_(std::move(names)) {}

  /// After each frame.
  void Turn(std::span<const FrameResult> results, std::int64_t now_ns, Console& console) noexcept;

 private:
  struct Object {
    TrackingState said = TrackingState::kInitialising;
    TrackingState seen = TrackingState::kInitialising;
    int changes = 0;  ///< Since the last message.
    bool any_said = false;
    std::int64_t said_ns = 0;
  };

  std::vector<Object> objects_;
  std::vector<std::string> names_;
};

}  // namespace disflow::apps
