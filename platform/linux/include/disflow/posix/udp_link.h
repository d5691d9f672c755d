// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <span>
#include <string>

#include "disflow/hal/byte_link.h"
#include "disflow/hal/link_address.h"
#include "disflow/posix/file_descriptor.h"

namespace disflow::posix {

/// One datagram per message to one peer, and datagrams from that peer back.
///
/// The host is looked up in the first Open() that succeeds, which may wait for a name server; later
/// ones take the same address and never wait. Where a name has both kinds of addresses, IPv4 is
/// taken, since ground stations listen there. A peer that is not there is no
/// error: what it refuses is counted.
class UdpLink final : public hal::ByteLink {
 public:
  /// Of what comes in: a full Ethernet frame, of which MAVLink fills a part.
  static constexpr std::size_t kMaxDatagramSize = 2048;
  /// What the system is asked to hold between two calls of Receive(), its own bookkeeping not
  /// counted. It gives less where net.core.rmem_max says so.
  static constexpr int kReceiveBuffer_bytes = 1 << 20;

  /// @param address Of kind kUdp.
  explicit UdpLink(const hal::LinkAddress& address);

  /// What shows input when something can be received; -1: not open.
  [[nodiscard]] int fd() const noexcept { return socket_.get(); }

 private:
  hal::Fault DoOpen() noexcept override;
  void DoClose() noexcept override;
  hal::Fault DoSend(std::span<const std::byte> message) noexcept override;
  /// One call takes as many datagrams as `buffer` has room for at kMaxDatagramSize each, one
  /// behind the other; a datagram that is longer than that, or than a shorter `buffer`, loses its
  /// tail.
  Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override;
  [[nodiscard]] const char* DoName() const noexcept override { return name_.c_str(); }
  [[nodiscard]] hal::LinkCounters DoCounters() const noexcept override { return counters_; }

  [[nodiscard]] Expected<std::size_t> ReceiveSome(std::span<std::byte> buffer,
                                                  unsigned& datagrams) noexcept;

  hal::LinkAddress address_;
  std::string name_;
  sockaddr_storage peer_{};
  socklen_t peer_size_ = 0;  ///< 0: not looked up yet.
  FileDescriptor socket_;
  hal::LinkCounters counters_;
};

}  // namespace disflow::posix
