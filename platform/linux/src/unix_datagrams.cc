// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/unix_datagrams.h"

#include <cerrno>
#include <cstddef>
#include <cstring>

namespace disflow::posix {

UnixDatagrams::UnixDatagrams(std::string_view name) noexcept {
  if (name.size() < 2 || (name[0] != '/' && name[0] != '@')) return;
  if (name.size() >= sizeof(peer_.sun_path)) return;
  peer_.sun_family = AF_UNIX;
  std::memcpy(peer_.sun_path, name.data(), name.size());
  if (name[0] == '@') peer_.sun_path[0] = '\0';
  peer_size_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  socket_ = FileDescriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

int UnixDatagrams::Send(std::string_view datagram) noexcept {
  const ssize_t sent = ::sendto(socket_.get(), datagram.data(), datagram.size(), MSG_NOSIGNAL,
                                reinterpret_cast<const sockaddr*>(&peer_), peer_size_);
  return sent < 0 ? errno : 0;
}

}  // namespace disflow::posix
