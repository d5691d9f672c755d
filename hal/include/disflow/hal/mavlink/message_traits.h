// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "disflow/hal/mavlink/crc.h"
#include "disflow/hal/mavlink/messages.h"

/// @file
/// Payload size and CRC_EXTRA of a message, derived at compile time from its list of fields.

namespace disflow::hal::mavlink {

/// The name that MAVLink definitions give to a field's type.
template <class T>
[[nodiscard]] constexpr std::string_view WireTypeName() noexcept {
  if constexpr (std::same_as<T, float>) {
    return "float";
  } else if constexpr (std::same_as<T, std::int8_t>) {
    return "int8_t";
  } else if constexpr (std::same_as<T, std::int32_t>) {
    return "int32_t";
  } else if constexpr (std::same_as<T, std::int64_t>) {
    return "int64_t";
  } else if constexpr (std::same_as<T, std::uint8_t>) {
    return "uint8_t";
  } else if constexpr (std::same_as<T, std::uint16_t>) {
    return "uint16_t";
  } else if constexpr (std::same_as<T, std::uint32_t>) {
    return "uint32_t";
  } else {
    static_assert(std::same_as<T, std::uint64_t>, "type is not used on the wire");
    return "uint64_t";
  }
}

/// Adds up the bytes of all fields.
struct PayloadSizeVisitor {
  std::size_t size = 0;

  template <class T>
  constexpr void operator()(const char* /*name*/, const T& /*value*/,
                            FieldKind /*kind*/ = FieldKind::kBase) noexcept {
    size += sizeof(T);
  }
};

/// Digests the definition: name, then type and name of every base field, arrays with their length.
/// Source: MAVLink guide, "Serialization", section "CRC_EXTRA calculation".
struct CrcExtraVisitor {
  Crc crc;

  template <class T>
  constexpr void operator()(std::string_view name, const T& /*value*/,
                            FieldKind kind = FieldKind::kBase) noexcept {
    if (kind == FieldKind::kBase) Digest(WireTypeName<T>(), name);
  }
  template <class T, std::size_t kSize>
  constexpr void operator()(std::string_view name, const std::array<T, kSize>& /*values*/,
                            FieldKind kind = FieldKind::kBase) noexcept {
    if (kind != FieldKind::kBase) return;
    Digest(WireTypeName<T>(), name);
    crc.Add(static_cast<std::uint8_t>(kSize));
  }
  constexpr void Digest(std::string_view type, std::string_view name) noexcept {
    crc.Add(type);
    crc.Add(std::string_view(" "));
    crc.Add(name);
    crc.Add(std::string_view(" "));
  }
};

template <class Message>
[[nodiscard]] consteval std::size_t PayloadSize() {
  Message message;
  PayloadSizeVisitor visitor;
  Message::VisitFields(message, visitor);
  return visitor.size;
}

template <class Message>
[[nodiscard]] consteval std::uint8_t CrcExtra() {
  Message message;
  CrcExtraVisitor visitor;
  visitor.crc.Add(Message::kName);
  visitor.crc.Add(std::string_view(" "));
  Message::VisitFields(message, visitor);
  const std::uint16_t crc = visitor.crc.value();
  return static_cast<std::uint8_t>((crc & 0xFFU) ^ (crc >> 8U));
}

template <class Message, class List>
inline constexpr bool kIsIn = false;
template <class Message, class... Messages>
inline constexpr bool kIsIn<Message, MessageList<Messages...>> = (std::same_as<Message, Messages> ||
                                                                  ...);

/// A message of the list KnownMessages.
template <class Message>
concept KnownMessage = kIsIn<Message, KnownMessages>;

// The published figures of the standard messages prove the rule; the private ones' stand in
// docs/wire-format.md and must never change.
static_assert(PayloadSize<Heartbeat>() == 9 && CrcExtra<Heartbeat>() == 50);
static_assert(PayloadSize<Odometry>() == 233 && CrcExtra<Odometry>() == 91);
static_assert(PayloadSize<CommandLong>() == 33 && CrcExtra<CommandLong>() == 152);
static_assert(PayloadSize<CommandAck>() == 10 && CrcExtra<CommandAck>() == 143);
static_assert(PayloadSize<SystemTime>() == 12 && CrcExtra<SystemTime>() == 137);
static_assert(PayloadSize<TimeSyncMessage>() == 18 && CrcExtra<TimeSyncMessage>() == 34);
static_assert(PayloadSize<LandingTarget>() == 60 && CrcExtra<LandingTarget>() == 200);
static_assert(PayloadSize<FollowTarget>() == 93 && CrcExtra<FollowTarget>() == 127);
static_assert(PayloadSize<GpsGlobalOrigin>() == 20 && CrcExtra<GpsGlobalOrigin>() == 39);
static_assert(PayloadSize<DisflowStatus>() == 76 && CrcExtra<DisflowStatus>() == 237);
static_assert(PayloadSize<DisflowReady>() == 28 && CrcExtra<DisflowReady>() == 194);
static_assert(PayloadSize<DisflowTiming>() == 76 && CrcExtra<DisflowTiming>() == 7);
static_assert(PayloadSize<DisflowQuery>() == 127 && CrcExtra<DisflowQuery>() == 12);
static_assert(PayloadSize<DisflowField>() == 216 && CrcExtra<DisflowField>() == 94);

}  // namespace disflow::hal::mavlink
