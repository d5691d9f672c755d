// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/socket_link.h"

#include <netdb.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstring>

#include "disflow/saturating.h"
#include "errno_fault.h"

namespace disflow::posix {
namespace {

constexpr std::string_view kUnix = "unix:";
constexpr std::string_view kTcp = "tcp:";

FileDescriptor ConnectUnix(const std::string& path, hal::Fault& fault) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof(address.sun_path)) {
    fault = hal::MakeFault(Status::kInvalidUri, "unix:%s: a path of 1 to %zu characters is needed",
                           path.c_str(), sizeof(address.sun_path) - 1);
    return {};
  }
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  FileDescriptor fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!fd.is_open() ||
      ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    fault = ErrnoFault(Status::kNotFound, path.c_str(), "nobody listens on this socket", errno);
    return {};
  }
  return fd;
}

FileDescriptor ConnectTcp(const std::string& name, hal::Fault& fault) {
  const std::size_t colon = name.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == name.size()) {
    fault = hal::MakeFault(Status::kInvalidUri, "tcp:%s: HOST:PORT is needed", name.c_str());
    return {};
  }
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const std::string host = name.substr(0, colon);
  if (const int error = ::getaddrinfo(host.c_str(), name.c_str() + colon + 1, &hints, &found);
      error != 0) {
    fault = hal::MakeFault(Status::kNotFound, "tcp:%s: %s", name.c_str(), ::gai_strerror(error));
    return {};
  }
  FileDescriptor connected;
  int error = 0;
  for (const addrinfo* one = found; one != nullptr && !connected.is_open(); one = one->ai_next) {
    FileDescriptor fd(::socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC, one->ai_protocol));
    if (fd.is_open() && ::connect(fd.get(), one->ai_addr, one->ai_addrlen) == 0) {
      connected = std::move(fd);
    } else {
      error = errno;
    }
  }
  ::freeaddrinfo(found);
  if (!connected.is_open()) {
    fault = ErrnoFault(Status::kNotFound, name.c_str(), "cannot connect", error);
  }
  return connected;
}

}  // namespace

bool SocketLink::IsSocketAddress(std::string_view address) noexcept {
  return address.starts_with(kUnix) || address.starts_with(kTcp);
}

hal::Fault SocketLink::DoOpen() noexcept {
  if (socket_.is_open()) return {};
  hal::Fault fault;
  FileDescriptor fd = name_.starts_with(kUnix) ? ConnectUnix(name_.substr(kUnix.size()), fault)
                                               : ConnectTcp(name_.substr(kTcp.size()), fault);
  if (!fault.ok()) return fault;
  socket_ = std::move(fd);
  pending_.clear();
  return {};
}

/// @return 0 or errno; EAGAIN if something is left.
int SocketLink::Flush() noexcept {
  std::size_t sent = 0;
  int error = 0;
  while (sent < pending_.size() && error == 0) {
    const ssize_t size = RetryOnSignal([&] {
      return ::send(socket_.get(), pending_.data() + sent, pending_.size() - sent,
                    MSG_DONTWAIT | MSG_NOSIGNAL);
    });
    if (size < 0) {
      error = errno;
    } else {
      sent += static_cast<std::size_t>(size);
    }
  }
  AddSaturating(counters_.sent_bytes, sent);
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(sent));
  return error;
}

hal::Fault SocketLink::DoSend(std::span<const std::byte> message) noexcept {
  if (!socket_.is_open()) return hal::MakeFault(Status::kNotOpen, "%s: not open", name());
  int error = Flush();
  if (error == EAGAIN) {
    AddSaturating(counters_.dropped_messages);
    return hal::MakeFault(Status::kWouldBlock, "%s: the far end does not take bytes", name());
  }
  if (error == 0) {
    pending_.assign(message.begin(), message.end());
    error = Flush();
  }
  if (error != 0 && error != EAGAIN) return Lost("cannot send", error);
  AddSaturating(counters_.sent_messages);
  return {};
}

Expected<std::size_t> SocketLink::DoReceive(std::span<std::byte> buffer) noexcept {
  if (!socket_.is_open()) return {0, Status::kNotOpen};
  if (const int error = Flush(); error != 0 && error != EAGAIN) {
    return {0, Lost("cannot send", error).status};
  }
  const ssize_t size = RetryOnSignal(
      [&] { return ::recv(socket_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT); });
  if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return {0};
  if (size <= 0) return {0, Lost("cannot receive", size < 0 ? errno : ECONNRESET).status};
  AddSaturating(counters_.received_bytes, static_cast<std::uint64_t>(size));
  return {static_cast<std::size_t>(size)};
}

hal::Fault SocketLink::Lost(const char* what, int error) noexcept {
  socket_.Reset();
  return ErrnoFault(Status::kDeviceLost, name(), what, error);
}

}  // namespace disflow::posix
