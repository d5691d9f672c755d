// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <endian.h>

#include <array>
#include <cstdint>

/// @file
/// What Linux's vhci_hcd says over its socket (Documentation/usb/usbip_protocol.rst): a virtual
/// USB host controller, whose devices are programs.

namespace disflow::hil {

enum class UsbipCommand : std::uint32_t {
  kSubmit = 1,
  kUnlink = 2,
  kSubmitReply = 3,
  kUnlinkReply = 4,
};

/// An unsigned number in network order.
struct Big32 {
  std::uint32_t raw = 0;
  Big32() = default;
  Big32(std::uint32_t value) : raw(htobe32(value)) {}  // NOLINT: a number like any other
  operator std::uint32_t() const { return be32toh(raw); }
};

struct UsbipHeader {
  Big32 command;
  Big32 sequence;
  Big32 device;
  Big32 direction;  ///< 1 = to the host.
  Big32 endpoint;
  // Of a request; replies use the same room for status, length and zeros.
  Big32 flags_or_status;
  Big32 length;
  Big32 start_frame;
  Big32 packets;
  Big32 interval_or_errors;
  std::array<std::uint8_t, 8> setup{};
};
static_assert(sizeof(UsbipHeader) == 48);

/// A control request as in chapter 9 of the USB specification.
struct SetupPacket {
  explicit SetupPacket(const std::array<std::uint8_t, 8>& bytes)
      : type(bytes[0]),
        request(bytes[1]),
        value(static_cast<std::uint16_t>(bytes[2] | bytes[3] << 8)),
        index(static_cast<std::uint16_t>(bytes[4] | bytes[5] << 8)),
        length(static_cast<std::uint16_t>(bytes[6] | bytes[7] << 8)) {}
  std::uint8_t type;
  std::uint8_t request;
  std::uint16_t value;
  std::uint16_t index;
  std::uint16_t length;
};

}  // namespace disflow::hil
