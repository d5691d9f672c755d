// SPDX-License-Identifier: BSD-3-Clause
#include "listen_check.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "disflow/posix/file_descriptor.h"

namespace disflow::posix {
namespace {

int Bind(int socket, const WebAddress& address) {
  const auto port = htons(static_cast<std::uint16_t>(address.port));
  if (address.is_ipv6) {
    sockaddr_in6 name{};
    name.sin6_family = AF_INET6;
    name.sin6_port = port;
    (void)inet_pton(AF_INET6, address.host.c_str(), &name.sin6_addr);
    return bind(socket, reinterpret_cast<const sockaddr*>(&name), sizeof(name));
  }
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_port = port;
  (void)inet_pton(AF_INET, address.host.c_str(), &name.sin_addr);
  return bind(socket, reinterpret_cast<const sockaddr*>(&name), sizeof(name));
}

hal::Fault Explain(int error, const WebAddress& address) {
  const std::string url = address.Url(address.port);
  switch (error) {
    case EADDRINUSE:
      return hal::MakeFault(Status::kBusy, "%s: another program listens there; choose another port",
                            url.c_str());
    case EACCES:
      return hal::MakeFault(Status::kPermissionDenied,
                            "%s: ports below 1024 are for root; choose another port", url.c_str());
    case EADDRNOTAVAIL:
    case EAFNOSUPPORT:
      return hal::MakeFault(Status::kNotFound, "%s: is no address of this machine", url.c_str());
    default:
      return hal::MakeFault(Status::kIoError, "%s: cannot be listened on: %s", url.c_str(),
                            std::strerror(error));
  }
}

}  // namespace

hal::Fault CheckListening(const WebAddress& address) {
  const FileDescriptor socket(
      ::socket(address.is_ipv6 ? AF_INET6 : AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (socket.get() < 0) return Explain(errno, address);
  const int on = 1;
  (void)setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  if (Bind(socket.get(), address) != 0 || listen(socket.get(), 1) != 0) {
    return Explain(errno, address);
  }
  return {};
}

hal::Fault CheckDescriptors(const WebAddress& address, unsigned needed) {
  rlimit limit{};
  // What the rest of the program has open comes on top.
  constexpr unsigned kOthers = 24;
  const rlim_t wanted = needed + kOthers;
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= wanted) return {};
  return hal::MakeFault(Status::kIoError,
                        "%s: only %ju files may be open at once, %ju are needed; allow more "
                        "(ulimit -n, LimitNOFILE= of the service)",
                        address.Url(address.port).c_str(), std::uintmax_t{limit.rlim_cur},
                        std::uintmax_t{wanted});
}

}  // namespace disflow::posix
