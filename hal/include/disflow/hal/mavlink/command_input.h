// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/hal/mavlink/frame.h"
#include "disflow/hal/mavlink/messages.h"
#include "disflow/hal/mavlink/telemetry.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow::hal::mavlink {

/// A command and who gave it.
struct ReceivedCommand {
  CommandLong command;
  std::uint8_t sender_system = 0;
  std::uint8_t sender_component = 0;
};

/// Keeps the commands of one link until they are obeyed or refused. There is room for few: who gets
/// no answer sends a command again.
class CommandInput {
 public:
  static constexpr int kMaxWaiting = 4;

  /// @param system_id Who is commanded; commands to others, and to all, are not for us.
  explicit CommandInput(std::uint8_t system_id = TelemetryOptions{}.system_id) noexcept
      : system_id_(system_id) {}

  /// Other messages are passed over.
  void Take(const FrameView& frame) noexcept;

  /// Oldest first.
  [[nodiscard]] const FixedVector<ReceivedCommand, kMaxWaiting>& waiting() const noexcept {
    return waiting_;
  }
  void Clear() noexcept { waiting_.clear(); }
  /// Commands that found no room; saturating.
  [[nodiscard]] std::uint32_t dropped() const noexcept { return dropped_; }

 private:
  std::uint8_t system_id_;
  FixedVector<ReceivedCommand, kMaxWaiting> waiting_;
  std::uint32_t dropped_ = 0;
};

/// @param result CommandAck::kAccepted, ...
[[nodiscard]] CommandAck AnswerTo(const ReceivedCommand& received, std::uint8_t result) noexcept;

}  // namespace disflow::hal::mavlink
