// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/tcp_link.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>

#include <cstring>
#include <utility>

#include "disflow/saturating.h"
#include "errno_fault.h"
#include "internet_host.h"

namespace disflow::posix {
namespace {

FileDescriptor MakeSocket(int family) noexcept {
  return FileDescriptor(::socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
}

/// What cannot be set only makes the link slower or its end later noticed.
void SetUp(int fd) noexcept {
  // Of what the peer does not take in time: some frames of poses, no seconds of old ones.
  constexpr int kWaiting_bytes = 4096;
  const int yes = 1;
  const int patience_ms = TcpLink::kPatience_ms;
  (void)::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
  (void)::setsockopt(fd, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kWaiting_bytes, sizeof(kWaiting_bytes));
  (void)::setsockopt(fd, IPPROTO_TCP, TCP_USER_TIMEOUT, &patience_ms, sizeof(patience_ms));
}

}  // namespace

TcpLink::TcpLink(const hal::LinkAddress& address)
    : address_(address), name_(NameOfHost("tcp://", address)) {}

int TcpLink::fd() const noexcept {
  if (stream_.is_open()) return stream_.fd();
  return listener_.get();
}

hal::Fault TcpLink::DoOpen() noexcept {
  if (open_) return {};
  hal::Fault fault = endpoint_size_ == 0 ? Resolve() : hal::Fault{};
  if (fault.ok() && address_.listens) fault = Listen();
  if (!fault.ok()) return fault;
  open_ = true;
  retry_ns_ = 0;
  (void)Attend();
  return {};
}

void TcpLink::DoClose() noexcept {
  open_ = false;
  stream_.Close();
  connecting_.Reset();
  listener_.Reset();
}

hal::Fault TcpLink::Resolve() noexcept {
  AddressList list(nullptr, &::freeaddrinfo);
  const hal::Fault fault = ResolveHost(address_, SOCK_STREAM, name(), list);
  if (!fault.ok()) return fault;
  for (const int family : {AF_INET, AF_INET6}) {
    for (const addrinfo* found = list.get(); found != nullptr; found = found->ai_next) {
      if (found->ai_family != family) continue;
      std::memcpy(&endpoint_, found->ai_addr, found->ai_addrlen);
      endpoint_size_ = found->ai_addrlen;
      return {};
    }
  }
  return hal::MakeFault(Status::kNotFound, "%s: host has no address", name());
}

hal::Fault TcpLink::Listen() noexcept {
  FileDescriptor fd = MakeSocket(endpoint_.ss_family);
  if (!fd.is_open()) return ErrnoFault(Status::kIoError, name(), "cannot make a socket", errno);
  // Or the port would be taken for a minute after a restart.
  const int yes = 1;
  (void)::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  if (::bind(fd.get(), reinterpret_cast<const sockaddr*>(&endpoint_), endpoint_size_) != 0) {
    if (errno == EADDRINUSE) {
      return hal::MakeFault(Status::kBusy,
                            "%s: the port is in use by another program; choose another port or "
                            "stop that program",
                            name());
    }
    const Status status = errno == EACCES ? Status::kPermissionDenied : Status::kIoError;
    return ErrnoFault(status, name(), "cannot listen at this address, is it one of this machine's?",
                      errno);
  }
  constexpr int kBacklog = 4;
  if (::listen(fd.get(), kBacklog) != 0) {
    return ErrnoFault(Status::kIoError, name(), "cannot listen", errno);
  }
  listener_ = std::move(fd);
  return {};
}

bool TcpLink::Attend() noexcept {
  if (address_.listens) {
    AcceptWaiting();
  } else if (connecting_.is_open()) {
    FinishConnecting();
  } else if (!stream_.is_open()) {
    StartConnecting();
  }
  return stream_.is_open();
}

void TcpLink::AcceptWaiting() noexcept {
  // No more than can wait, so that nobody can hold this by connecting again and again.
  constexpr int kAtOnce = 8;
  for (int i = 0; i < kAtOnce; ++i) {
    FileDescriptor fd(RetryOnSignal([this] {
      return ::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    }));
    if (!fd.is_open()) return;
    if (!stream_.is_open()) TakeConnection(std::move(fd));
  }
}

void TcpLink::StartConnecting() noexcept {
  const std::int64_t now_ns = clock_.NowNs();
  if (now_ns < retry_ns_) return;
  retry_ns_ = now_ns + kRetry_ns;
  FileDescriptor fd = MakeSocket(endpoint_.ss_family);
  if (!fd.is_open()) return;
  const int connected =
      ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&endpoint_), endpoint_size_);
  if (connected == 0) return TakeConnection(std::move(fd));
  if (errno == EINPROGRESS) connecting_ = std::move(fd);
}

void TcpLink::FinishConnecting() noexcept {
  pollfd state{.fd = connecting_.get(), .events = POLLOUT, .revents = 0};
  if (RetryOnSignal([&] { return ::poll(&state, 1, 0); }) <= 0) {
    // The system tries for minutes; a server that is back is to be found sooner.
    if (clock_.NowNs() - retry_ns_ > std::int64_t{kPatience_ms} * 1'000'000) connecting_.Reset();
    return;
  }
  int error = 0;
  socklen_t size = sizeof(error);
  const int asked = ::getsockopt(connecting_.get(), SOL_SOCKET, SO_ERROR, &error, &size);
  if (asked == 0 && error == 0) return TakeConnection(std::move(connecting_));
  connecting_.Reset();
}

void TcpLink::TakeConnection(FileDescriptor connected) noexcept {
  SetUp(connected.get());
  stream_.Take(std::move(connected));
  if (std::exchange(was_connected_, true)) AddSaturating(counters_.reconnects);
}

hal::Fault TcpLink::DoSend(std::span<const std::byte> message) noexcept {
  if (!open_) return hal::MakeFault(Status::kNotOpen, "%s: not open", name());
  if (Attend()) {
    const hal::Fault fault = stream_.Send(message, name(), counters_);
    // A peer that goes is looked for again.
    if (fault.status != Status::kDeviceLost) return fault;
  }
  AddSaturating(counters_.refused_messages);
  return {};
}

Expected<std::size_t> TcpLink::DoReceive(std::span<std::byte> buffer) noexcept {
  if (!open_) return {0, Status::kNotOpen};
  if (!Attend()) return {0};
  const Expected<std::size_t> received = stream_.Receive(buffer, name(), counters_);
  return received.status == Status::kDeviceLost ? Expected<std::size_t>{0} : received;
}

}  // namespace disflow::posix
