// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/camera/libcamera_sensor.h"

#include <libcamera/control_ids.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "camera/camera_choice.h"
#include "camera/frame_stamp.h"
#include "disflow/posix/monotonic_clock.h"
#include "disflow/saturating.h"
#include "libcamera_session.h"

namespace disflow::posix {

using hal::Fault;
using hal::MakeFault;

namespace {

constexpr int kHeldFrames = 2;
constexpr std::int64_t kWatchdog_ns = 2'000'000'000;

std::int64_t NowNs() {
  MonotonicClock clock;
  return clock.NowNs();
}

}  // namespace

struct LibcameraSensor::State {
  CameraAddress address;
  CameraDescription description;
  std::string name;
  hal::SensorCounters counters;
  LibcameraSession session;
  CameraDescription chosen;  ///< With unit.
  bool open = false;
  std::array<libcamera::Request*, kHeldFrames> held{};
  std::size_t slot = 0;  ///< Of held, the next to be used.
  std::vector<std::uint16_t> converted;
  SequenceCheck sequence;
  std::int64_t alive_ns = 0;

  /// libcamera ends the whole program by an assertion if a camera is stopped that has vanished with
  /// requests under way, so it is left as it is; a new start of the program finds it again.
  Fault Abandon(const char* what) {
    session.Abandon();
    open = false;
    return MakeFault(Status::kIoError,
                     "%s: %s; libcamera cannot take it back while running: start again",
                     name.c_str(), what);
  }
  Fault Judge(const libcamera::Request& request);
  void Lend(libcamera::Request& request, DepthFrame& frame);
};

/// Counts a frame's faults.
Fault LibcameraSensor::State::Judge(const libcamera::Request& request) {
  const libcamera::FrameMetadata& metadata = session.Metadata(request);
  const bool is_good = request.status() == libcamera::Request::RequestComplete &&
                       metadata.status == libcamera::FrameMetadata::FrameSuccess;
  if (!is_good) {
    AddSaturating(counters.corrupt);
    AddSaturating(counters.flagged);
    return MakeFault(
        Status::kCorrupt, "%s: a request %s", name.c_str(),
        request.status() == libcamera::Request::RequestCancelled ? "was cancelled" : "failed");
  }
  alive_ns = NowNs();
  const SequenceCheck::Verdict order = sequence.Judge(metadata.sequence);
  AddSaturating(counters.gaps, order.missing);
  AddSaturating(counters.dropped, order.missing);
  const std::size_t needed =
      session.stride_bytes() * static_cast<std::size_t>(session.height_px() - 1) +
      MinRowBytes(session.format(), session.width_px());
  if (metadata.planes()[0].bytesused < needed) {
    AddSaturating(counters.corrupt);
    AddSaturating(counters.short_frames);
    return MakeFault(Status::kTruncated, "%s: frame %u has %u of %zu bytes", name.c_str(),
                     metadata.sequence, metadata.planes()[0].bytesused, needed);
  }
  return {};
}

void LibcameraSensor::State::Lend(libcamera::Request& request, DepthFrame& frame) {
  const DepthPixelFormat& format = session.format();
  const auto width = static_cast<std::size_t>(session.width_px());
  const auto height = static_cast<std::size_t>(session.height_px());
  frame = {};
  frame.depth.data = session.Image(request);
  frame.depth.width_px = session.width_px();
  frame.depth.height_px = session.height_px();
  frame.depth.stride_bytes = static_cast<std::ptrdiff_t>(session.stride_bytes());
  if (format.conversion != DepthPixelFormat::Conversion::kNone) {
    std::uint16_t* const out = converted.data() + slot * width * height;
    for (std::size_t v = 0; v < height; ++v) {
      ConvertRow(format, session.Image(request) + v * session.stride_bytes(),
                 {out + v * width, width});
    }
    frame.depth.data = out;
    frame.depth.stride_bytes = static_cast<std::ptrdiff_t>(2 * width);
  }
  frame.depth.format = DepthFormat::kUint16;
  frame.depth.unit_m = chosen.unit_m;
  frame.camera = chosen.camera;
  const auto stamp = request.metadata().get(libcamera::controls::SensorTimestamp);
  frame.stamp_ns = stamp ? *stamp : static_cast<std::int64_t>(session.Metadata(request).timestamp);
  held[slot] = &request;
  slot = (slot + 1) % held.size();
  AddSaturating(counters.frames);
}

LibcameraSensor::LibcameraSensor(const CameraAddress& address, const CameraDescription& description)
    : state_(std::make_unique<State>()) {
  state_->address = address;
  state_->description = description;
  state_->name = std::string("libcamera:") + address.device;
}

LibcameraSensor::~LibcameraSensor() { DoClose(); }

Fault LibcameraSensor::DoOpen() noexcept {
  State& state = *state_;
  if (state.open) return {};
  CameraDescription chosen;
  Fault fault = ChooseIntrinsics(state.address, state.description, chosen);
  if (!fault.ok()) return fault;
  if (state.address.unit_m > 0.0F) chosen.unit_m = state.address.unit_m;
  if (!(chosen.unit_m > 0.0F)) {
    return MakeFault(Status::kUnsupported,
                     "%s: the unit of its depth is not known; look it up and say "
                     "depth_scale=0.001 or the like",
                     state.name.c_str());
  }
  fault = state.session.Open(state.address, chosen);
  if (!fault.ok()) return fault;
  if (state.session.format().conversion != DepthPixelFormat::Conversion::kNone) {
    state.converted.assign(static_cast<std::size_t>(kHeldFrames * state.session.width_px()) *
                               static_cast<std::size_t>(state.session.height_px()),
                           0);
  }
  state.open = true;
  state.chosen = chosen;
  state.held.fill(nullptr);
  state.sequence.Restart();
  state.alive_ns = NowNs();
  return {};
}

Fault LibcameraSensor::DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept {
  State& state = *state_;
  if (!state.open) {
    return MakeFault(Status::kNotOpen, "%s: is not open", state.name.c_str());
  }
  libcamera::Request*& oldest = state.held[state.slot];
  constexpr const char* kRefused = "takes no request any more";
  if (oldest != nullptr && !state.session.Return(oldest)) return state.Abandon(kRefused);
  oldest = nullptr;
  const std::int64_t watchdog_ns = state.alive_ns + kWatchdog_ns - NowNs();
  libcamera::Request* newest = state.session.Take(std::min(timeout_ns, watchdog_ns));
  if (state.session.disconnected()) return state.Abandon("the camera is gone");
  if (newest == nullptr) {
    if (timeout_ns >= watchdog_ns) return state.Abandon("delivers nothing for 2 s");
    return MakeFault(Status::kTimeout, "%s: no frame came in time", state.name.c_str());
  }
  Fault fault = state.Judge(*newest);
  // Older frames give way to newer ones, and damaged ones to any.
  while (libcamera::Request* const next = state.session.Take(0)) {
    const Fault judged = state.Judge(*next);
    libcamera::Request* const surplus = judged.ok() || !fault.ok() ? newest : next;
    if (judged.ok() && fault.ok()) {
      AddSaturating(state.counters.skipped);
      AddSaturating(state.counters.dropped);
    }
    if (surplus == newest) {
      newest = next;
      fault = judged;
    }
    if (!state.session.Return(surplus)) return state.Abandon(kRefused);
  }
  if (fault.ok()) {
    state.Lend(*newest, frame);
    return {};
  }
  return state.session.Return(newest) ? fault : state.Abandon(kRefused);
}

void LibcameraSensor::DoClose() noexcept {
  state_->session.Close();
  state_->open = false;
}

hal::SensorInfo LibcameraSensor::DoInfo() const noexcept {
  const State& state = *state_;
  hal::SensorInfo info;
  info.name = state.name.c_str();
  info.width_px = state.session.width_px();
  info.height_px = state.session.height_px();
  info.rate_hz = state.address.rate_hz;
  info.live = true;
  info.stamp_point = hal::StampPoint::kStartOfExposure;  // what SensorTimestamp is defined as
  info.held_frames = kHeldFrames;
  return info;
}

hal::SensorCounters LibcameraSensor::DoCounters() const noexcept { return state_->counters; }

}  // namespace disflow::posix
