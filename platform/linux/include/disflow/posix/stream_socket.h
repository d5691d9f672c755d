// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "disflow/hal/byte_link.h"
#include "disflow/posix/file_descriptor.h"

namespace disflow::posix {

/// Messages through a connected socket of bytes: each is sent whole or not at all, although the
/// socket may take a part of one only. Never blocks.
class StreamSocket {
 public:
  /// Whatever was left of a message for an earlier connection is forgotten.
  void Take(FileDescriptor connected) noexcept;
  void Close() noexcept { Take(FileDescriptor()); }
  [[nodiscard]] bool is_open() const noexcept { return socket_.is_open(); }
  [[nodiscard]] int fd() const noexcept { return socket_.get(); }

  /// As ByteLink's; after kDeviceLost it is closed.
  /// @param name Of the link, for messages.
  [[nodiscard]] hal::Fault Send(std::span<const std::byte> message, const char* name,
                                hal::LinkCounters& counters) noexcept;
  [[nodiscard]] Expected<std::size_t> Receive(std::span<std::byte> buffer, const char* name,
                                              hal::LinkCounters& counters) noexcept;

 private:
  [[nodiscard]] int Flush(hal::LinkCounters& counters) noexcept;
  [[nodiscard]] hal::Fault Lost(const char* name, const char* what, int error) noexcept;

  FileDescriptor socket_;
  std::vector<std::byte> pending_;  ///< What the socket did not take of a message yet.
};

}  // namespace disflow::posix
