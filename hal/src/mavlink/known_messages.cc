// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/known_messages.h"

#include <algorithm>
#include <array>

#include "disflow/hal/mavlink/message_traits.h"

namespace disflow::hal::mavlink {
namespace {

struct MessageFacts {
  std::uint32_t id;
  std::uint8_t crc_extra;
};

template <class... Messages>
constexpr std::array<MessageFacts, sizeof...(Messages)> FactsOf(MessageList<Messages...>) noexcept {
  return {{{Messages::kId, CrcExtra<Messages>()}...}};
}

constexpr auto kKnownMessages = FactsOf(KnownMessages{});

}  // namespace

Expected<std::uint8_t> CrcExtraOf(std::uint32_t message_id) noexcept {
  const auto* const known =
      std::find_if(kKnownMessages.begin(), kKnownMessages.end(),
                   [message_id](const MessageFacts& message) { return message.id == message_id; });
  if (known == kKnownMessages.end()) return {0, Status::kUnsupported};
  return {known->crc_extra};
}

}  // namespace disflow::hal::mavlink
