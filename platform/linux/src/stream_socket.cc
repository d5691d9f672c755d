// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/stream_socket.h"

#include <sys/socket.h>

#include <utility>

#include "disflow/saturating.h"
#include "errno_fault.h"

namespace disflow::posix {

void StreamSocket::Take(FileDescriptor connected) noexcept {
  socket_ = std::move(connected);
  pending_.clear();
}

/// @return 0 or errno; EAGAIN if something is left.
int StreamSocket::Flush(hal::LinkCounters& counters) noexcept {
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
  AddSaturating(counters.sent_bytes, sent);
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(sent));
  return error;
}

hal::Fault StreamSocket::Send(std::span<const std::byte> message, const char* name,
                              hal::LinkCounters& counters) noexcept {
  int error = Flush(counters);
  if (error == EAGAIN) {
    AddSaturating(counters.dropped_messages);
    return hal::MakeFault(Status::kWouldBlock, "%s: the far end does not take bytes", name);
  }
  if (error == 0) {
    pending_.assign(message.begin(), message.end());
    error = Flush(counters);
  }
  if (error != 0 && error != EAGAIN) return Lost(name, "cannot send", error);
  AddSaturating(counters.sent_messages);
  return {};
}

Expected<std::size_t> StreamSocket::Receive(std::span<std::byte> buffer, const char* name,
                                            hal::LinkCounters& counters) noexcept {
  if (const int error = Flush(counters); error != 0 && error != EAGAIN) {
    return {0, Lost(name, "cannot send", error).status};
  }
  const ssize_t size = RetryOnSignal(
      [&] { return ::recv(socket_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT); });
  if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return {0};
  if (size <= 0) return {0, Lost(name, "cannot receive", size < 0 ? errno : ECONNRESET).status};
  AddSaturating(counters.received_bytes, static_cast<std::uint64_t>(size));
  return {static_cast<std::size_t>(size)};
}

hal::Fault StreamSocket::Lost(const char* name, const char* what, int error) noexcept {
  socket_.Reset();
  return ErrnoFault(Status::kDeviceLost, name, what, error);
}

}  // namespace disflow::posix
