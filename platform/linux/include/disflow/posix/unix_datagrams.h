// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include <string_view>

#include "disflow/posix/file_descriptor.h"

namespace disflow::posix {

/// Sends datagrams to a socket of this machine that has a name, as systemd and its journal listen
/// on. Never blocks, never allocates.
class UnixDatagrams {
 public:
  UnixDatagrams() noexcept = default;
  /// @param name A path, or a name in the abstract space, written with an '@'. Anything else gives
  /// nobody to send to.
  explicit UnixDatagrams(std::string_view name) noexcept;

  /// @return Whether there is somebody to send to, by name at least.
  [[nodiscard]] bool is_open() const noexcept { return socket_.is_open(); }
  [[nodiscard]] int fd() const noexcept { return socket_.get(); }
  /// @return 0 or errno; EAGAIN if the other side does not read.
  [[nodiscard]] int Send(std::string_view datagram) noexcept;

 private:
  FileDescriptor socket_;
  sockaddr_un peer_{};
  socklen_t peer_size_ = 0;
};

}  // namespace disflow::posix
