// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "disflow/hal/byte_link.h"
#include "disflow/posix/stream_socket.h"

namespace disflow::posix {

/// A stream of bytes through a socket: a serial line that another program makes available, such as
/// an emulator or a terminal server.
class SocketLink final : public hal::ByteLink {
 public:
  /// @param address `unix:PATH` or `tcp:HOST:PORT`, see IsSocketAddress().
  explicit SocketLink(std::string_view address) : name_(address) {}

  [[nodiscard]] static bool IsSocketAddress(std::string_view address) noexcept;
  /// Before anything is opened. @return kInvalidUri with what is wrong.
  [[nodiscard]] static hal::Fault CheckAddress(const std::string& address) noexcept;

 private:
  hal::Fault DoOpen() noexcept override;
  void DoClose() noexcept override { socket_.Close(); }
  hal::Fault DoSend(std::span<const std::byte> message) noexcept override;
  Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override;
  [[nodiscard]] const char* DoName() const noexcept override { return name_.c_str(); }
  [[nodiscard]] hal::LinkCounters DoCounters() const noexcept override { return counters_; }

  std::string name_;
  StreamSocket socket_;
  hal::LinkCounters counters_;
};

}  // namespace disflow::posix
