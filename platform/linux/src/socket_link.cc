// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/socket_link.h"

#include <sys/socket.h>
#include <sys/un.h>

#include <cstring>
#include <utility>

#include "disflow/hal/link_address.h"
#include "errno_fault.h"
#include "internet_host.h"

namespace disflow::posix {
namespace {

constexpr std::string_view kUnix = "unix:";
constexpr std::string_view kTcp = "tcp:";

/// @param path Of a socket.
hal::Fault CheckPath(const std::string& path) {
  constexpr std::size_t kRoom = sizeof(sockaddr_un::sun_path);
  if (!path.empty() && path.size() < kRoom) return {};
  return hal::MakeFault(Status::kInvalidUri, "unix:%s: a path of 1 to %zu characters is needed",
                        path.c_str(), kRoom - 1);
}

/// Reads HOST:PORT as links everywhere have it.
hal::Fault ParseEndpoint(const std::string& name, hal::LinkAddress& address) {
  if (name.find('?') != std::string::npos)
    return hal::MakeFault(Status::kInvalidUri, "tcp:%s: has no options", name.c_str());
  const hal::Fault fault = hal::ParseLinkAddress("tcp://" + name, address);
  if (fault.ok()) return {};
  return hal::MakeFault(Status::kInvalidUri,
                        "tcp:%s: HOST:PORT is needed, an IPv6 address in brackets, the port a "
                        "number from 1 to 65535",
                        name.c_str());
}

FileDescriptor ConnectUnix(const std::string& path, hal::Fault& fault) {
  fault = CheckPath(path);
  if (!fault.ok()) return {};
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
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
  hal::LinkAddress address;
  fault = ParseEndpoint(name, address);
  AddressList found(nullptr, &::freeaddrinfo);
  if (fault.ok()) fault = ResolveHost(address, SOCK_STREAM, name.c_str(), found);
  if (!fault.ok()) return {};
  FileDescriptor connected;
  int error = 0;
  for (const addrinfo* one = found.get(); one != nullptr && !connected.is_open();
       one = one->ai_next) {
    FileDescriptor fd(::socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC, one->ai_protocol));
    if (fd.is_open() && ::connect(fd.get(), one->ai_addr, one->ai_addrlen) == 0) {
      connected = std::move(fd);
    } else {
      error = errno;
    }
  }
  if (!connected.is_open()) {
    fault = ErrnoFault(Status::kNotFound, name.c_str(), "cannot connect", error);
  }
  return connected;
}

}  // namespace

bool SocketLink::IsSocketAddress(std::string_view address) noexcept {
  return address.starts_with(kUnix) || address.starts_with(kTcp);
}

hal::Fault SocketLink::CheckAddress(const std::string& address) noexcept {
  if (address.starts_with(kUnix)) return CheckPath(address.substr(kUnix.size()));
  hal::LinkAddress parsed;
  return ParseEndpoint(address.substr(kTcp.size()), parsed);
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
