// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "disflow/hal/fault.h"

namespace disflow::hal {

/// Counted since the link was constructed; saturating.
struct LinkCounters {
  std::uint32_t sent_messages = 0;
  std::uint32_t dropped_messages = 0;  ///< The link could not take them (full buffer, peer gone).
  std::uint32_t refused_messages = 0;  ///< The peer answered that nobody listens there (UDP).
  std::uint64_t sent_bytes = 0;
  std::uint64_t received_bytes = 0;
  std::uint32_t overrun_bytes = 0;  ///< Arrived while the receive buffer was full (UART).
  std::uint32_t reconnects = 0;     ///< Times Open() brought back a link that had been lost.
};

/// Something that carries bytes both ways: UDP socket, serial port, UART. Never blocks. Not
/// thread-safe.
class ByteLink {
 public:
  ByteLink(const ByteLink&) = delete;
  ByteLink& operator=(const ByteLink&) = delete;

  /// Idempotent after success. After kDeviceLost it may be called again until the device is back.
  /// @return kOk, kNotFound, kPermissionDenied, kBusy, kUnsupported, kIoError; see the message.
  [[nodiscard]] Fault Open() noexcept { return DoOpen(); }
  /// Idempotent.
  void Close() noexcept { DoClose(); }

  /// Sends a whole message or nothing.
  /// @return kOk, kWouldBlock (nothing sent, counted as dropped), kDeviceLost, kNotOpen, kIoError.
  [[nodiscard]] Fault Send(std::span<const std::byte> message) noexcept { return DoSend(message); }

  /// Takes bytes that have arrived, without waiting.
  /// @return Number of bytes written into `buffer`, 0 if none are there; status as Send().
  [[nodiscard]] Expected<std::size_t> Receive(std::span<std::byte> buffer) noexcept {
    return DoReceive(buffer);
  }

  /// The address as a person would write it, e.g. "udp://127.0.0.1:14550"; owned by the link.
  [[nodiscard]] const char* name() const noexcept { return DoName(); }
  [[nodiscard]] LinkCounters counters() const noexcept { return DoCounters(); }

 protected:
  ByteLink() = default;
  ~ByteLink() = default;  // see DepthSensor

 private:
  virtual Fault DoOpen() noexcept = 0;
  virtual void DoClose() noexcept = 0;
  virtual Fault DoSend(std::span<const std::byte> message) noexcept = 0;
  virtual Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept = 0;
  [[nodiscard]] virtual const char* DoName() const noexcept = 0;
  [[nodiscard]] virtual LinkCounters DoCounters() const noexcept = 0;
};

}  // namespace disflow::hal
