// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "disflow/hal/byte_link.h"
#include "disflow/hal/link_address.h"
#include "disflow/posix/monotonic_clock.h"
#include "disflow/posix/stream_socket.h"

namespace disflow::posix {

/// Messages to one peer over TCP: to a server, or from whoever connects.
///
/// The host is looked up in the first Open() that succeeds, which may wait for a name server;
/// nothing later ever waits. A peer that is not there is no error: what could not be sent to it is
/// counted as refused. A server is tried again every second. Who connects is served alone until it
/// goes; others are turned away. A peer that answers nothing for kPatience_ms has gone.
class TcpLink final : public hal::ByteLink {
 public:
  static constexpr std::int64_t kRetry_ns = 1'000'000'000;
  static constexpr int kPatience_ms = 5000;

  /// @param address Of kind kTcp.
  explicit TcpLink(const hal::LinkAddress& address);

  /// What shows input when something is to be received or to be accepted; -1: nothing is open.
  [[nodiscard]] int fd() const noexcept;

 private:
  hal::Fault DoOpen() noexcept override;
  void DoClose() noexcept override;
  hal::Fault DoSend(std::span<const std::byte> message) noexcept override;
  Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override;
  [[nodiscard]] const char* DoName() const noexcept override { return name_.c_str(); }
  [[nodiscard]] hal::LinkCounters DoCounters() const noexcept override { return counters_; }

  [[nodiscard]] hal::Fault Resolve() noexcept;
  [[nodiscard]] hal::Fault Listen() noexcept;
  /// Sees to a connection without waiting for it. @return Whether there is one.
  [[nodiscard]] bool Attend() noexcept;
  void AcceptWaiting() noexcept;
  void StartConnecting() noexcept;
  void FinishConnecting() noexcept;
  void TakeConnection(FileDescriptor connected) noexcept;

  hal::LinkAddress address_;
  std::string name_;
  sockaddr_storage endpoint_{};
  socklen_t endpoint_size_ = 0;  ///< 0: not looked up yet.
  bool open_ = false;
  bool was_connected_ = false;
  FileDescriptor listener_;
  FileDescriptor connecting_;
  std::int64_t retry_ns_ = 0;
  StreamSocket stream_;
  MonotonicClock clock_;
  hal::LinkCounters counters_;
};

}  // namespace disflow::posix
