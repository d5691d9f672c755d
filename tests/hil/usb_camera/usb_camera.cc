// SPDX-License-Identifier: BSD-3-Clause
#include "usb_camera.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "disflow/posix/monotonic_clock.h"
#include "disflow/posix/timespec.h"

namespace disflow::hil {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr int kHighSpeed = 3;  // of enum usb_device_speed
constexpr std::uint32_t kDeviceId = 0x10001;

// bmRequestType and bRequest of what the host asks.
constexpr std::uint8_t kStandardIn = 0x80;
constexpr std::uint8_t kClassInterfaceIn = 0xA1;
constexpr std::uint8_t kGetDescriptor = 6;
constexpr std::uint8_t kGetConfiguration = 8;
constexpr std::uint8_t kSetConfiguration = 9;
constexpr std::uint8_t kClearFeature = 1;
constexpr std::uint8_t kEndpointOut = 0x02;
constexpr std::uint8_t kUvcGetInfo = 0x86;
constexpr std::uint8_t kUvcGetLen = 0x85;

// Bits of a payload's header.
constexpr std::uint8_t kEndOfHeader = 0x80;
constexpr std::uint8_t kErrorBit = 0x40;
constexpr std::uint8_t kEndOfFrame = 0x02;

[[noreturn]] void Fail(const std::string& what) {
  throw std::runtime_error(what + ": " + std::strerror(errno));
}

/// @return false if the host hung up.
bool ReadAll(int fd, void* data, std::size_t size) {
  auto* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t count = ::read(fd, at, size);
    if (count == 0 || (count < 0 && errno == ECONNRESET)) return false;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) Fail("read from vhci");
    at += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

void WriteAll(int fd, const void* data, std::size_t size) {
  const auto* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t count = ::send(fd, at, size, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EPIPE) return;  // noticed by the next read
    if (count < 0) Fail("write to vhci");
    at += count;
    size -= static_cast<std::size_t>(count);
  }
}

std::int64_t NowNs() {
  posix::MonotonicClock clock;
  return clock.NowNs();
}

}  // namespace

UsbCamera::UsbCamera(const CameraModelOptions& options, FaultPlan faults, std::ifstream frames,
                     int frame_count)
    : options_(options),
      faults_(std::move(faults)),
      file_(std::move(frames)),
      frame_count_(frame_count) {}

void UsbCamera::Attach() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) Fail("socketpair");
  socket_ = ends[0];
  const std::string line = "0 " + std::to_string(ends[1]) + " " + std::to_string(kDeviceId) + " " +
                           std::to_string(kHighSpeed);
  const int file = ::open(options_.attach_file.c_str(), O_WRONLY | O_CLOEXEC);
  // The port may need a moment after the last device has gone.
  bool attached = false;
  for (int attempt = 0; attempt < 100 && file >= 0 && !attached; ++attempt) {
    attached = ::write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
    if (!attached) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (!attached) Fail(options_.attach_file);
  (void)::close(file);
  (void)::close(ends[1]);  // the kernel has its own reference
  transfers_.clear();
  streaming_ = sending_ = false;
}

void UsbCamera::Detach() {
  if (socket_ >= 0) (void)::close(socket_);
  socket_ = -1;
}

void UsbCamera::Step() {
  const std::int64_t now_ns = NowNs();
  if (streaming_ && !sending_ && next_frame_ < frame_count_ && now_ns >= due_ns_) {
    StartFrame(now_ns);
  }
  SendWhatFits();
  const bool waits_for_time = streaming_ && !sending_ && next_frame_ < frame_count_;
  const std::int64_t wait_ns =
      waits_for_time ? std::max<std::int64_t>(due_ns_ - NowNs(), 0) : 100 * kMs;
  pollfd entry{socket_, POLLIN, 0};
  const timespec timeout = disflow::posix::ToTimespec(wait_ns);
  if (::ppoll(&entry, 1, &timeout, nullptr) > 0) Serve();
}

void UsbCamera::Serve() {
  UsbipHeader header;
  if (!ReadAll(socket_, &header, sizeof(header))) throw std::runtime_error("vhci hung up");
  switch (static_cast<UsbipCommand>(std::uint32_t{header.command})) {
    case UsbipCommand::kSubmit:
      return Submit(header);
    case UsbipCommand::kUnlink:
      return Unlink(header);
    default:
      throw std::runtime_error("vhci sent an unknown command");
  }
}

void UsbCamera::Submit(const UsbipHeader& header) {
  if (header.endpoint == 0) return Control(header);
  // The stream's transfers wait for an image.
  transfers_.push_back({header.sequence, header.length});
  if (!streaming_) due_ns_ = NowNs();
  streaming_ = true;
}

void UsbCamera::Unlink(const UsbipHeader& header) {
  const std::uint32_t wanted = header.flags_or_status;  // the transfer's sequence number
  const auto found =
      std::find_if(transfers_.begin(), transfers_.end(),
                   [wanted](const Transfer& transfer) { return transfer.sequence == wanted; });
  UsbipHeader reply;
  reply.command = static_cast<std::uint32_t>(UsbipCommand::kUnlinkReply);
  reply.sequence = header.sequence;
  if (found != transfers_.end()) {
    transfers_.erase(found);
    reply.flags_or_status = static_cast<std::uint32_t>(-ECONNRESET);
  }
  WriteAll(socket_, &reply, sizeof(reply));
  if (transfers_.empty()) streaming_ = sending_ = false;
}

void UsbCamera::Control(const UsbipHeader& header) {
  const SetupPacket setup(header.setup);
  const bool to_host = header.direction == 1;
  Bytes answer(to_host ? 0 : std::uint32_t{header.length});
  if (!answer.empty() && !ReadAll(socket_, answer.data(), answer.size())) return;
  if (!Answer(setup, answer)) return Reply(header.sequence, -EPIPE, nullptr, 0, to_host);
  const auto length =
      static_cast<std::uint32_t>(std::min<std::size_t>(answer.size(), header.length));
  Reply(header.sequence, 0, answer.data(), length, to_host);
}

/// @param answer Holds what came with the request; receives what goes back.
bool UsbCamera::Answer(const SetupPacket& setup, Bytes& answer) {
  if (setup.type == kStandardIn && setup.request == kGetDescriptor) {
    const int index = setup.value & 0xFF;
    switch (setup.value >> 8) {
      case 1:
        answer = DeviceDescriptor(options_);
        return true;
      case 2:
        answer = ConfigurationDescriptor(options_);
        return true;
      case 3:
        answer = StringDescriptor(options_, index);
        return index <= 3;
      default:
        return false;  // no qualifier: it runs at high speed only
    }
  }
  if (setup.type == kClassInterfaceIn) {
    answer = StreamControl(options_);
    if (setup.request == kUvcGetLen) answer = {static_cast<std::uint8_t>(answer.size()), 0};
    if (setup.request == kUvcGetInfo) answer = {3};
    return (setup.index & 0xFF) == kStreamInterface;
  }
  if (setup.type == kStandardIn) {
    answer.assign(2, 0);
    if (setup.request == kGetConfiguration) answer = {configuration_};
    return true;
  }
  if (setup.type == kEndpointOut && setup.request == kClearFeature) {
    streaming_ = sending_ = false;  // how uvcvideo says that nobody wants the stream any more
  }
  if (setup.type == 0 && setup.request == kSetConfiguration) {
    configuration_ = static_cast<std::uint8_t>(setup.value);
  }
  return true;
}

void UsbCamera::Reply(std::uint32_t sequence, std::int32_t status, const std::uint8_t* data,
                      std::uint32_t length, bool to_host) {
  UsbipHeader reply;
  reply.command = static_cast<std::uint32_t>(UsbipCommand::kSubmitReply);
  reply.sequence = sequence;
  reply.flags_or_status = static_cast<std::uint32_t>(status);
  reply.length = length;
  WriteAll(socket_, &reply, sizeof(reply));
  if (to_host && length > 0) WriteAll(socket_, data, length);
}

void UsbCamera::StartFrame(std::int64_t now_ns) {
  const std::int64_t period_ns = 1'000'000'000 / options_.rate_hz;
  std::uint8_t flags = kEndOfHeader | kEndOfFrame;
  std::size_t image_bytes = options_.image_bytes();
  const auto planned = faults_.find(next_frame_);
  if (planned != faults_.end()) {
    const FrameFault fault = planned->second;
    if (fault.value_ms > 0) {
      // Done once; the frame itself comes afterwards.
      faults_.erase(planned);
      due_ns_ = now_ns + fault.value_ms * kMs;
      if (fault.kind != FrameFault::Kind::kDetach) return;
      Detach();
      std::this_thread::sleep_for(std::chrono::milliseconds(fault.value_ms));
      return Attach();
    }
    if (fault.kind == FrameFault::Kind::kError) flags |= kErrorBit;
    if (fault.kind == FrameFault::Kind::kShort) image_bytes /= 2;
  }
  payload_.assign(CameraModelOptions::kPayloadHeader + image_bytes, 0);
  payload_[0] = CameraModelOptions::kPayloadHeader;
  payload_[1] = static_cast<std::uint8_t>(flags | (toggle_ ? 1 : 0));
  if (planned != faults_.end() && planned->second.kind == FrameFault::Kind::kGarbage) {
    payload_[0] = 1;  // shorter than any header
  }
  file_.seekg(static_cast<std::streamoff>(next_frame_) * options_.image_bytes());
  file_.read(reinterpret_cast<char*>(payload_.data()) + CameraModelOptions::kPayloadHeader,
             static_cast<std::streamsize>(image_bytes));
  if (!file_) throw std::runtime_error("the file of frames is too short");
  sending_ = true;
  sent_ = 0;
  toggle_ = !toggle_;
  // A slow host delays frames, but none is left out.
  due_ns_ = std::max(due_ns_ + period_ns, now_ns);
}

void UsbCamera::SendWhatFits() {
  while (sending_ && !transfers_.empty()) {
    const Transfer transfer = transfers_.front();
    transfers_.pop_front();
    const auto length =
        static_cast<std::uint32_t>(std::min<std::size_t>(payload_.size() - sent_, transfer.length));
    Reply(transfer.sequence, 0, payload_.data() + sent_, length, true);
    sent_ += length;
    if (sent_ < payload_.size()) continue;
    sending_ = false;
    ++next_frame_;
  }
}

}  // namespace disflow::hil
