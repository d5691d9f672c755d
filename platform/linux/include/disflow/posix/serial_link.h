// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <termios.h>

#include <array>
#include <string>

#include "disflow/hal/byte_link.h"
#include "disflow/hal/link_address.h"
#include "disflow/posix/file_descriptor.h"

namespace disflow::posix {

/// A serial port: raw, 8 data bits, no parity, 1 stop bit, no flow control, exclusive.
///
/// A message that the driver took only in part is completed before anything else is sent, so the
/// line never carries half a message; messages that arrive meanwhile are dropped and counted.
class SerialLink final : public hal::ByteLink {
 public:
  /// Longest message; holds every MAVLink frame.
  static constexpr std::size_t kMaxMessageSize = 512;

  /// @param address Of kind kSerial.
  explicit SerialLink(const hal::LinkAddress& address);
  ~SerialLink();

  /// What shows input when something can be received; -1: not open.
  [[nodiscard]] int fd() const noexcept { return port_.get(); }

 private:
  hal::Fault DoOpen() noexcept override;
  /// Waits a fraction of a second for what is on its way, then gives back the port with the
  /// settings that it had.
  void DoClose() noexcept override;
  hal::Fault DoSend(std::span<const std::byte> message) noexcept override;
  Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override;
  [[nodiscard]] const char* DoName() const noexcept override { return name_.c_str(); }
  [[nodiscard]] hal::LinkCounters DoCounters() const noexcept override { return counters_; }

  [[nodiscard]] hal::Fault Configure(int fd) noexcept;
  /// Writes what is left of a message.
  /// @return 0 if all is written or the driver is full, else errno.
  [[nodiscard]] int FlushPending() noexcept;
  void Drain() noexcept;
  [[nodiscard]] hal::Fault SendFailed(int error) noexcept;
  void Lose() noexcept;

  hal::LinkAddress address_;
  std::string name_;
  FileDescriptor port_;
  termios original_{};
  std::array<std::byte, kMaxMessageSize> pending_{};
  std::size_t pending_begin_ = 0;
  std::size_t pending_end_ = 0;
  bool lost_ = false;
  hal::LinkCounters counters_;
};

}  // namespace disflow::posix
