// SPDX-License-Identifier: BSD-3-Clause
#include "v4l2_stream.h"

#include <algorithm>
#include <cerrno>

#include "disflow/types.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

/// Some cameras take more than a second to start.
constexpr std::int64_t kMinWatchdog_ns = 2 * kSecond_ns;
constexpr float kWatchdogFrames = 10.0F;
/// Then the device is closed and opened again.
constexpr int kMostSilentRestarts = 3;

Fault OpenFault(const char* name, int error) noexcept {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
    case ENOTDIR:
      return MakeFault(Status::kNotFound,
                       "%s: no such device; is the camera plugged in? See --list-sensors", name);
    case EACCES:
    case EPERM:
      return MakeFault(Status::kPermissionDenied,
                       "%s: no permission; add your user to the group that owns it (video)", name);
    default:
      return VideoFault(name, "cannot open", error);
  }
}

}  // namespace

Fault V4l2Stream::Open(const VideoNode& node, const CameraAddress& address,
                       const CameraDescription& description) {
  name_ = node.path;
  buffers_.set_name(name_.c_str());
  fd_ = kernel_.Open(name_.c_str());
  if (fd_ < 0) return OpenFault(name_.c_str(), errno);
  const Fault fault = Prepare(node, address, description);
  if (!fault.ok()) Close();
  return fault;
}

Fault V4l2Stream::Prepare(const VideoNode& node, const CameraAddress& address,
                          const CameraDescription& description) {
  const char* const name = name_.c_str();
  const StreamRequest request{address.format, description.width_px, description.height_px,
                              address.rate_hz};
  Fault fault = CheckCapabilities(kernel_, fd_, name);
  if (fault.ok()) fault = NegotiateStream(kernel_, fd_, name, request, layout_);
  if (fault.ok()) fault = ChooseUnit(address, description, *layout_.format, node, unit_m_);
  if (fault.ok()) fault = buffers_.Acquire(fd_, layout_.image_bytes);
  if (fault.ok()) fault = buffers_.Start();
  if (!fault.ok()) return fault;
  camera_ = description.camera;
  held_.fill(kNone);
  sequence_.Restart();
  alive_ns_ = kernel_.NowNs();
  silent_restarts_ = 0;
  if (layout_.format->conversion != DepthPixelFormat::Conversion::kNone) {
    const auto pixels =
        static_cast<std::size_t>(layout_.width_px) * static_cast<std::size_t>(layout_.height_px);
    converted_.assign(pixels * kHeldFrames, 0);
  }
  return {};
}

void V4l2Stream::Close() noexcept {
  if (fd_ < 0) return;
  buffers_.Release();
  kernel_.Close(fd_);
  fd_ = -1;
}

std::int64_t V4l2Stream::WatchdogNs() const noexcept {
  if (!(layout_.rate_hz > 0.0F)) return kMinWatchdog_ns;
  const auto frames_ns = static_cast<std::int64_t>(kWatchdogFrames / layout_.rate_hz * 1e9F);
  return std::max(kMinWatchdog_ns, frames_ns);
}

Fault V4l2Stream::Next(std::int64_t timeout_ns, DepthFrame& frame) noexcept {
  Fault fault = Return(held_[slot_]);
  held_[slot_] = kNone;
  const std::int64_t deadline_ns = kernel_.NowNs() + timeout_ns;
  while (fault.ok()) {
    v4l2_buffer newest;
    fault = TakeNewest(newest);
    if (fault.ok()) return Lend(newest, frame);
    if (fault.status != Status::kWouldBlock) break;
    const std::int64_t now_ns = kernel_.NowNs();
    const std::int64_t watchdog_ns = alive_ns_ + WatchdogNs();
    if (now_ns >= watchdog_ns) return Restart("delivers nothing");
    if (now_ns >= deadline_ns) {
      return MakeFault(Status::kTimeout, "%s: no frame came in time", name_.c_str());
    }
    fault = {};
    if (!kernel_.Wait(fd_, std::min(deadline_ns, watchdog_ns) - now_ns) && errno == EINTR) {
      return MakeFault(Status::kTimeout, "%s: interrupted", name_.c_str());
    }
  }
  return fault;
}

/// Empties the driver's queue and keeps the last good frame.
/// @return kWouldBlock if there is nothing, kTruncated or kCorrupt if there is nothing good.
Fault V4l2Stream::TakeNewest(v4l2_buffer& newest) noexcept {
  Fault verdict = MakeFault(Status::kWouldBlock, "%s: nothing there", name_.c_str());
  bool have_one = false;
  // A driver that is always faster than this loop must not keep it here for ever.
  for (std::uint32_t i = 0; i < V4l2Buffers::kMost; ++i) {
    v4l2_buffer buffer;
    const int error = buffers_.Dequeue(buffer);
    if (error == EAGAIN) break;
    if (error != 0) return DriverFailed(error);
    const Fault judged = Inspect(buffer);
    if (judged.status == Status::kUnsupported) return judged;
    const bool replaces = judged.ok();
    if (replaces && have_one) AddSaturating(counters_.skipped);
    if (replaces && have_one) AddSaturating(counters_.dropped);
    const std::uint32_t surplus = !replaces ? buffer.index : have_one ? newest.index : kNone;
    if (replaces) newest = buffer;
    have_one = have_one || replaces;
    if (!have_one) verdict = judged;
    if (const Fault fault = Return(surplus); !fault.ok()) return fault;
  }
  return have_one ? Fault{} : verdict;
}

/// Counts a frame's faults.
Fault V4l2Stream::Inspect(const v4l2_buffer& buffer) noexcept {
  alive_ns_ = kernel_.NowNs();
  silent_restarts_ = 0;
  const SequenceCheck::Verdict order = sequence_.Judge(buffer.sequence);
  AddSaturating(counters_.gaps, order.missing);
  AddSaturating(counters_.dropped, order.missing);
  if (order.late && counters_.gaps > 0) {
    // Not missing after all, but too old to be of use.
    --counters_.gaps;
    AddSaturating(counters_.skipped);
    return MakeFault(Status::kWouldBlock, "%s: frame %u came late", name_.c_str(), buffer.sequence);
  }
  if (buffer.bytesused < layout_.image_bytes) {
    AddSaturating(counters_.corrupt);
    AddSaturating(counters_.short_frames);
    return MakeFault(Status::kTruncated, "%s: frame %u has %u of %zu bytes", name_.c_str(),
                     buffer.sequence, buffer.bytesused, layout_.image_bytes);
  }
  if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0) {
    AddSaturating(counters_.corrupt);
    AddSaturating(counters_.flagged);
    return MakeFault(Status::kCorrupt, "%s: the driver marked frame %u as damaged", name_.c_str(),
                     buffer.sequence);
  }
  if (!IsMonotonic(buffer)) {
    return MakeFault(Status::kUnsupported,
                     "%s: its driver's stamps are not of the monotonic clock, so nobody knows when "
                     "a frame was taken",
                     name_.c_str());
  }
  return {};
}

Fault V4l2Stream::Return(std::uint32_t index) noexcept {
  if (index == kNone) return {};
  const int error = buffers_.Enqueue(index);
  return error == 0 ? Fault{} : DriverFailed(error);
}

Fault V4l2Stream::DriverFailed(int error) noexcept {
  if (error == ENODEV || error == ENXIO) {
    return VideoFault(name_.c_str(), "", error);
  }
  return Restart(error == EIO ? "reports a transfer error" : "fails");
}

Fault V4l2Stream::Restart(const char* reason) noexcept {
  if (++silent_restarts_ > kMostSilentRestarts) {
    return MakeFault(Status::kDeviceLost,
                     "%s: %s, also after %d starts of the stream; opening it "
                     "anew",
                     name_.c_str(), reason, kMostSilentRestarts);
  }
  AddSaturating(counters_.restarts);
  // What was lent out comes back: its owner may see it overwritten, but only by a camera that had
  // failed.
  buffers_.Stop();
  held_.fill(kNone);
  sequence_.Restart();
  alive_ns_ = kernel_.NowNs();
  const Fault fault = buffers_.Start();
  if (!fault.ok()) {
    return MakeFault(Status::kDeviceLost, "%s", fault.message);
  }
  return MakeFault(Status::kTimeout, "%s: %s, the stream was started anew", name_.c_str(), reason);
}

Fault V4l2Stream::Lend(const v4l2_buffer& buffer, DepthFrame& frame) noexcept {
  const bool converts = layout_.format->conversion != DepthPixelFormat::Conversion::kNone;
  stamp_point_ = StampPointOf(buffer);
  frame = {};
  frame.depth.data = Image(buffer.index);
  frame.depth.width_px = layout_.width_px;
  frame.depth.height_px = layout_.height_px;
  frame.depth.stride_bytes = converts ? 2 * std::ptrdiff_t{layout_.width_px}
                                      : static_cast<std::ptrdiff_t>(layout_.stride_bytes);
  frame.depth.format = DepthFormat::kUint16;
  frame.depth.unit_m = unit_m_;
  frame.camera = camera_;
  frame.stamp_ns = StampNsOf(buffer);
  held_[slot_] = buffer.index;
  slot_ = (slot_ + 1) % held_.size();
  AddSaturating(counters_.frames);
  return {};
}

/// The depth image in a buffer, or its conversion in the slot that is about to be used.
const void* V4l2Stream::Image(std::uint32_t index) noexcept {
  const std::byte* const image = buffers_.data(index) + layout_.offset_bytes;
  if (layout_.format->conversion == DepthPixelFormat::Conversion::kNone) return image;
  const auto width = static_cast<std::size_t>(layout_.width_px);
  const auto height = static_cast<std::size_t>(layout_.height_px);
  std::uint16_t* const out = converted_.data() + slot_ * width * height;
  for (std::size_t v = 0; v < height; ++v) {
    ConvertRow(*layout_.format, image + v * layout_.stride_bytes, {out + v * width, width});
  }
  return out;
}

int V4l2Stream::Dmabuf(const void* data) const noexcept {
  for (const std::uint32_t index : held_) {
    if (index != kNone && buffers_.data(index) + layout_.offset_bytes == data) {
      return buffers_.dmabuf(index);
    }
  }
  return -1;
}

}  // namespace disflow::posix
