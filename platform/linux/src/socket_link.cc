// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/socket_link.h"

#include <netdb.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstring>

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
  socket_.Take(std::move(fd));
  return {};
}

hal::Fault SocketLink::DoSend(std::span<const std::byte> message) noexcept {
  if (!socket_.is_open()) return hal::MakeFault(Status::kNotOpen, "%s: not open", name());
  return socket_.Send(message, name(), counters_);
}

Expected<std::size_t> SocketLink::DoReceive(std::span<std::byte> buffer) noexcept {
  if (!socket_.is_open()) return {0, Status::kNotOpen};
  return socket_.Receive(buffer, name(), counters_);
}

}  // namespace disflow::posix
