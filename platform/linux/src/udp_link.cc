// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/udp_link.h"

#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "disflow/saturating.h"
#include "errno_fault.h"
#include "internet_host.h"

namespace disflow::posix {
namespace {

/// Taken with one call of the system.
constexpr std::size_t kMaxDatagrams = 64;

/// Binds to `port` on every address of the family.
int BindAny(int fd, int family, std::uint16_t port) noexcept {
  if (family == AF_INET6) {
    sockaddr_in6 own{};
    own.sin6_family = AF_INET6;
    own.sin6_addr = in6addr_any;
    own.sin6_port = htons(port);
    return ::bind(fd, reinterpret_cast<const sockaddr*>(&own), sizeof(own));
  }
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = htonl(INADDR_ANY);
  own.sin_port = htons(port);
  return ::bind(fd, reinterpret_cast<const sockaddr*>(&own), sizeof(own));
}

hal::Fault Connect(const sockaddr_storage& peer, socklen_t peer_size,
                   const hal::LinkAddress& address, const char* name,
                   FileDescriptor& out) noexcept {
  FileDescriptor fd(::socket(peer.ss_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!fd.is_open()) return ErrnoFault(Status::kIoError, name, "cannot make a socket", errno);

  // Without it a broadcast address is refused; for other addresses it changes nothing.
  const int yes = 1;
  if (::setsockopt(fd.get(), SOL_SOCKET, SO_BROADCAST, &yes, sizeof(yes)) != 0) {
    return ErrnoFault(Status::kIoError, name, "cannot allow broadcast", errno);
  }
  // Less is no reason to go without the link.
  const int size = UdpLink::kReceiveBuffer_bytes;
  (void)::setsockopt(fd.get(), SOL_SOCKET, SO_RCVBUF, &size, sizeof(size));
  if (address.bind_port != 0 && BindAny(fd.get(), peer.ss_family, address.bind_port) != 0) {
    if (errno == EADDRINUSE) {
      return hal::MakeFault(Status::kBusy,
                            "%s: own port %u is in use by another program; choose another ?bind= "
                            "port or stop that program",
                            name, unsigned{address.bind_port});
    }
    const Status status = errno == EACCES ? Status::kPermissionDenied : Status::kIoError;
    return ErrnoFault(status, name, "cannot bind to the ?bind= port", errno);
  }
  if (::connect(fd.get(), reinterpret_cast<const sockaddr*>(&peer), peer_size) != 0) {
    return ErrnoFault(Status::kIoError, name, "no route to the peer", errno);
  }
  out = std::move(fd);
  return {};
}

}  // namespace

UdpLink::UdpLink(const hal::LinkAddress& address)
    : address_(address), name_(NameOfHost("udp://", address)) {}

hal::Fault UdpLink::DoOpen() noexcept {
  if (socket_.is_open()) return {};
  if (peer_size_ > 0) return Connect(peer_, peer_size_, address_, name(), socket_);
  AddressList list(nullptr, &::freeaddrinfo);
  hal::Fault fault = ResolveHost(address_, SOCK_DGRAM, name(), list);
  if (!fault.ok()) return fault;

  fault = hal::MakeFault(Status::kNotFound, "%s: host has no address", name());
  for (const int family : {AF_INET, AF_INET6}) {
    for (const addrinfo* peer = list.get(); peer != nullptr; peer = peer->ai_next) {
      if (peer->ai_family != family) continue;
      sockaddr_storage found{};
      std::memcpy(&found, peer->ai_addr, peer->ai_addrlen);
      fault = Connect(found, peer->ai_addrlen, address_, name(), socket_);
      if (fault.ok()) {
        peer_ = found;
        peer_size_ = peer->ai_addrlen;
      }
      // A port in use is the user's to solve; another family would only hide it.
      if (fault.ok() || fault.status == Status::kBusy) return fault;
    }
  }
  return fault;
}

void UdpLink::DoClose() noexcept { socket_.Reset(); }

hal::Fault UdpLink::DoSend(std::span<const std::byte> message) noexcept {
  if (!socket_.is_open()) return hal::MakeFault(Status::kNotOpen, "%s: not open", name());
  const auto send = [&] {
    return ::send(socket_.get(), message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  };
  ssize_t sent = RetryOnSignal(send);
  if (sent < 0 && errno == ECONNREFUSED) {
    // The answer to an earlier datagram; reading it cleared it, and this one has not been sent yet.
    AddSaturating(counters_.refused_messages);
    sent = RetryOnSignal(send);
  }
  if (sent >= 0) {
    AddSaturating(counters_.sent_messages);
    AddSaturating(counters_.sent_bytes, message.size());
    return {};
  }
  const int error = errno;
  AddSaturating(counters_.dropped_messages);
  switch (error) {
    case EAGAIN:
    case ECONNREFUSED:
    case ENOBUFS:
    case ENOMEM:
      return ErrnoFault(Status::kWouldBlock, name(), "message dropped", error);
    case ENETDOWN:
    case ENETUNREACH:
    case EHOSTDOWN:
    case EHOSTUNREACH:
      // A cable may come back; the socket stays good.
      return ErrnoFault(Status::kWouldBlock, name(), "message dropped, check the network", error);
    default:
      return ErrnoFault(Status::kIoError, name(), "cannot send", error);
  }
}

Expected<std::size_t> UdpLink::DoReceive(std::span<std::byte> buffer) noexcept {
  if (!socket_.is_open()) return {0, Status::kNotOpen};
  // Datagrams without a byte must not look like the end, nor hold the caller for ever.
  constexpr int kEmptyTurns = 64;
  for (int turn = 0; turn < kEmptyTurns; ++turn) {
    unsigned datagrams = 0;
    const Expected<std::size_t> received = ReceiveSome(buffer, datagrams);
    if (!received.ok() || received.value > 0 || datagrams == 0) return received;
  }
  return {0};
}

Expected<std::size_t> UdpLink::ReceiveSome(std::span<std::byte> buffer,
                                           unsigned& datagrams) noexcept {
  std::array<iovec, kMaxDatagrams> rooms;
  std::array<mmsghdr, kMaxDatagrams> messages;
  const std::size_t count =
      std::clamp<std::size_t>(buffer.size() / kMaxDatagramSize, 1, kMaxDatagrams);
  const std::size_t room = std::min(buffer.size(), kMaxDatagramSize);
  for (std::size_t i = 0; i < count; ++i) {
    rooms[i] = {buffer.data() + i * room, room};
    messages[i] = {};
    messages[i].msg_hdr.msg_iov = &rooms[i];
    messages[i].msg_hdr.msg_iovlen = 1;
  }
  const auto receive = [&] {
    return ::recvmmsg(socket_.get(), messages.data(), static_cast<unsigned>(count), MSG_DONTWAIT,
                      nullptr);
  };
  int received = RetryOnSignal(receive);
  if (received < 0 && errno == ECONNREFUSED) {
    // The answer to an earlier datagram of ours; what waits behind it is none the worse.
    AddSaturating(counters_.refused_messages);
    received = RetryOnSignal(receive);
  }
  if (received < 0) {
    const bool nothing = errno == EAGAIN || errno == ECONNREFUSED;
    return {0, nothing ? Status::kOk : Status::kIoError};
  }
  datagrams = static_cast<unsigned>(received);
  std::size_t size = 0;
  for (std::size_t i = 0; i < datagrams; ++i) {
    std::memmove(buffer.data() + size, rooms[i].iov_base, messages[i].msg_len);
    size += messages[i].msg_len;
  }
  AddSaturating(counters_.received_bytes, size);
  return {size};
}

}  // namespace disflow::posix
