// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/command_input.h"

#include "disflow/saturating.h"

namespace disflow::hal::mavlink {

void CommandInput::Take(const FrameView& frame) noexcept {
  ReceivedCommand received;
  if (DecodePayload(frame, received.command) != Status::kOk) return;
  if (received.command.target_system != system_id_) return;
  received.sender_system = frame.header.system_id;
  received.sender_component = frame.header.component_id;
  if (!waiting_.push_back(received)) AddSaturating(dropped_);
}

CommandAck AnswerTo(const ReceivedCommand& received, std::uint8_t result) noexcept {
  CommandAck ack;
  ack.command = received.command.command;
  ack.result = result;
  ack.target_system = received.sender_system;
  ack.target_component = received.sender_component;
  return ack;
}

}  // namespace disflow::hal::mavlink
