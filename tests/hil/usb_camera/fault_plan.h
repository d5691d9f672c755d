// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace disflow::hil {

/// What goes wrong at which frame.
struct FrameFault {
  enum class Kind : std::uint8_t {
    kError,    ///< Payload header says that the image is damaged.
    kShort,    ///< Half of the image is missing.
    kGarbage,  ///< Payload header makes no sense.
    kStall,    ///< Nothing for value_ms.
    kDetach,   ///< Unplugged ahead of this frame, plugged in again after value_ms.
  };
  Kind kind = Kind::kError;
  int value_ms = 0;
};

using FaultPlan = std::map<int, FrameFault>;

/// Reads "FRAME:KIND" or "FRAME:KIND=MS". @return false if it is none.
inline bool AddFault(std::string_view text, FaultPlan& plan) {
  const std::map<std::string_view, FrameFault::Kind> kinds{{"error", FrameFault::Kind::kError},
                                                           {"short", FrameFault::Kind::kShort},
                                                           {"garbage", FrameFault::Kind::kGarbage},
                                                           {"stall", FrameFault::Kind::kStall},
                                                           {"detach", FrameFault::Kind::kDetach}};
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return false;
  std::string_view kind = text.substr(colon + 1);
  std::string_view value = "0";
  if (const std::size_t equals = kind.find('='); equals != std::string_view::npos) {
    value = kind.substr(equals + 1);
    kind = kind.substr(0, equals);
  }
  int frame = -1;
  FrameFault fault;
  const auto read = [](std::string_view number, int& out) {
    return std::from_chars(number.data(), number.data() + number.size(), out).ec == std::errc{};
  };
  if (!kinds.contains(kind) || !read(text.substr(0, colon), frame) ||
      !read(value, fault.value_ms)) {
    return false;
  }
  fault.kind = kinds.at(kind);
  plan[frame] = fault;
  return true;
}

}  // namespace disflow::hil
