// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/serial_link.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>

#include <algorithm>

#include "baud_rates.h"
#include "disflow/posix/monotonic_clock.h"
#include "disflow/saturating.h"
#include "errno_fault.h"

namespace disflow::posix {
namespace {

constexpr std::int64_t kNsPerMs = 1'000'000;
constexpr int kDrainSteps = 300;  ///< Of one millisecond: 512 bytes at 19200 baud.

bool IsGone(int error) noexcept {
  return error == EIO || error == ENODEV || error == ENXIO || error == EPIPE;
}

hal::Fault OpenFault(const char* name, int error) noexcept {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
    case EIO:
    case ENOTDIR:
      return ErrnoFault(Status::kNotFound, name, "no such device; is it plugged in?", error);
    case EACCES:
    case EPERM:
      return ErrnoFault(Status::kPermissionDenied, name,
                        "no permission; add your user to the group that owns it (dialout)", error);
    case EBUSY:
      return ErrnoFault(Status::kBusy, name, "in use by another program", error);
    default:
      return ErrnoFault(Status::kIoError, name, "cannot open", error);
  }
}

hal::Fault Claim(int fd, const char* name) noexcept {
  if (::isatty(fd) == 0) {
    return hal::MakeFault(Status::kUnsupported, "%s: not a serial port", name);
  }
  // The lock keeps out programs that look for it, TIOCEXCL all others; root passes the second.
  if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
    return hal::MakeFault(Status::kBusy, "%s: in use by another program", name);
  }
  if (::ioctl(fd, TIOCEXCL) != 0) {
    return ErrnoFault(Status::kIoError, name, "cannot claim it exclusively", errno);
  }
  return {};
}

}  // namespace

SerialLink::SerialLink(const hal::LinkAddress& address)
    : address_(address), name_(std::string("serial://") + address.device) {}

SerialLink::~SerialLink() { DoClose(); }

hal::Fault SerialLink::DoOpen() noexcept {
  if (port_.is_open()) return {};
  FileDescriptor fd(RetryOnSignal(
      [this] { return ::open(address_.device, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC); }));
  if (!fd.is_open()) return OpenFault(name(), errno);
  hal::Fault fault = Claim(fd.get(), name());
  if (!fault.ok()) return fault;
  if (::tcgetattr(fd.get(), &original_) != 0) {
    return ErrnoFault(Status::kIoError, name(), "cannot read the port's settings", errno);
  }
  fault = Configure(fd.get());
  if (!fault.ok()) {
    (void)::tcsetattr(fd.get(), TCSANOW, &original_);
    return fault;
  }
  port_ = std::move(fd);
  pending_begin_ = pending_end_ = 0;
  if (lost_) AddSaturating(counters_.reconnects);
  lost_ = false;
  return {};
}

hal::Fault SerialLink::Configure(int fd) noexcept {
  const auto* const rate = std::find_if(
      kBaudRates.begin(), kBaudRates.end(),
      [this](const BaudRate& candidate) { return candidate.bits_per_s == address_.baud; });
  if (rate == kBaudRates.end()) {
    return hal::MakeFault(Status::kUnsupported,
                          "%s: %u baud is no standard rate; use one such as 57600, 115200, 460800, "
                          "921600, 1500000, 3000000, 4000000",
                          name(), unsigned{address_.baud});
  }
  termios wanted = original_;
  ::cfmakeraw(&wanted);
  wanted.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | PARENB | CRTSCTS | CSIZE);
  wanted.c_cflag |= static_cast<tcflag_t>(CS8 | CLOCAL | CREAD);
  // At least one byte, or a read could not tell "nothing there" from "hung up".
  wanted.c_cc[VMIN] = 1;
  wanted.c_cc[VTIME] = 0;
  if (::cfsetispeed(&wanted, rate->constant) != 0 || ::cfsetospeed(&wanted, rate->constant) != 0 ||
      RetryOnSignal([&] { return ::tcsetattr(fd, TCSANOW, &wanted); }) != 0) {
    return ErrnoFault(Status::kUnsupported, name(), "cannot be set to raw 8N1 at this rate", errno);
  }
  // tcsetattr succeeds if it could do anything at all of what was asked: read back what it did.
  termios actual{};
  if (::tcgetattr(fd, &actual) != 0) {
    return ErrnoFault(Status::kIoError, name(), "cannot read the port's settings", errno);
  }
  if (::cfgetospeed(&actual) != rate->constant || (actual.c_cflag & CSIZE) != CS8 ||
      (actual.c_cflag & PARENB) != 0) {
    return hal::MakeFault(Status::kUnsupported,
                          "%s: the driver does not do %u baud 8N1; choose another ?baud= rate",
                          name(), unsigned{address_.baud});
  }
  (void)::tcflush(fd, TCIOFLUSH);
  return {};
}

void SerialLink::DoClose() noexcept {
  if (!port_.is_open()) return;
  Drain();
  // The device may be gone by now; there is nothing left to restore then.
  (void)::tcsetattr(port_.get(), TCSANOW, &original_);
  (void)::ioctl(port_.get(), TIOCNXCL);
  port_.Reset();
}

void SerialLink::Drain() noexcept {
  MonotonicClock clock;
  for (int step = 0; step < kDrainSteps; ++step) {
    if (FlushPending() != 0) return;
    int queued = 0;
    const bool is_known = ::ioctl(port_.get(), TIOCOUTQ, &queued) == 0;
    if (pending_begin_ == pending_end_ && (!is_known || queued == 0)) return;
    clock.SleepUntilNs(clock.NowNs() + kNsPerMs);
  }
}

int SerialLink::FlushPending() noexcept {
  while (pending_begin_ < pending_end_) {
    const ssize_t written = RetryOnSignal([this] {
      return ::write(port_.get(), pending_.data() + pending_begin_, pending_end_ - pending_begin_);
    });
    if (written < 0) return errno == EAGAIN ? 0 : errno;
    if (written == 0) return 0;
    pending_begin_ += static_cast<std::size_t>(written);
    AddSaturating(counters_.sent_bytes, static_cast<std::uint64_t>(written));
  }
  return 0;
}

hal::Fault SerialLink::DoSend(std::span<const std::byte> message) noexcept {
  if (!port_.is_open()) {
    return hal::MakeFault(Status::kNotOpen, "%s: not open%s", name(),
                          lost_ ? ", the device was lost" : "");
  }
  if (message.size() > kMaxMessageSize) {
    AddSaturating(counters_.dropped_messages);
    return hal::MakeFault(Status::kIoError, "%s: message of %zu bytes; at most %zu are allowed",
                          name(), message.size(), kMaxMessageSize);
  }
  if (const int error = FlushPending(); error != 0) return SendFailed(error);
  if (pending_begin_ < pending_end_) return SendFailed(EAGAIN);

  std::copy(message.begin(), message.end(), pending_.begin());
  pending_begin_ = 0;
  pending_end_ = message.size();
  const int error = FlushPending();
  if (error == 0 && pending_begin_ == 0 && !message.empty()) {
    // Not one byte went out, so the message can still be dropped as a whole.
    pending_end_ = 0;
    return SendFailed(EAGAIN);
  }
  if (error != 0) return SendFailed(error);
  AddSaturating(counters_.sent_messages);
  return {};
}

hal::Fault SerialLink::SendFailed(int error) noexcept {
  AddSaturating(counters_.dropped_messages);
  if (error == EAGAIN) {
    return hal::MakeFault(Status::kWouldBlock,
                          "%s: message dropped, the line is slower than the telemetry; raise "
                          "?baud= or lower the rate",
                          name());
  }
  Lose();
  if (!IsGone(error)) return ErrnoFault(Status::kIoError, name(), "cannot send", error);
  return ErrnoFault(Status::kDeviceLost, name(),
                    "the device vanished while sending; plug it in again", error);
}

void SerialLink::Lose() noexcept {
  port_.Reset();
  lost_ = true;
}

Expected<std::size_t> SerialLink::DoReceive(std::span<std::byte> buffer) noexcept {
  if (!port_.is_open()) return {0, Status::kNotOpen};
  if (buffer.empty()) return {0};
  const ssize_t received =
      RetryOnSignal([&] { return ::read(port_.get(), buffer.data(), buffer.size()); });
  if (received > 0) {
    const auto size = static_cast<std::size_t>(received);
    AddSaturating(counters_.received_bytes, size);
    return {size};
  }
  if (received < 0 && errno == EAGAIN) return {0};
  const bool is_gone = received == 0 || IsGone(errno);
  Lose();
  return {0, is_gone ? Status::kDeviceLost : Status::kIoError};
}

}  // namespace disflow::posix
