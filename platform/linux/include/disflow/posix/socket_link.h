// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "disflow/hal/byte_link.h"
#include "disflow/posix/file_descriptor.h"

namespace disflow::posix {

/// A stream of bytes through a socket: a serial line that another program makes available, such as
/// an emulator or a terminal server.
class SocketLink final : public hal::ByteLink {
 public:
  /// @param address `unix:PATH` or `tcp:HOST:PORT`, see IsSocketAddress().
  explicit SocketLink(std::string_view address) : name_(address) {}

  [[nodiscard]] static bool IsSocketAddress(std::string_view address) noexcept;

 private:
  hal::Fault DoOpen() noexcept override;
  void DoClose() noexcept override { socket_.Reset(); }
  hal::Fault DoSend(std::span<const std::byte> message) noexcept override;
  Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override;
  [[nodiscard]] const char* DoName() const noexcept override { return name_.c_str(); }
  [[nodiscard]] hal::LinkCounters DoCounters() const noexcept override { return counters_; }

  [[nodiscard]] int Flush() noexcept;
  [[nodiscard]] hal::Fault Lost(const char* what, int error) noexcept;

  std::string name_;
  FileDescriptor socket_;
  std::vector<std::byte> pending_;  ///< What the socket did not take of a message yet.
  hal::LinkCounters counters_;
};

}  // namespace disflow::posix
