// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/camera/v4l2_sensor.h"

#include <cerrno>
#include <string>

#include "v4l2_stream.h"

namespace disflow::posix {

using hal::Fault;

struct V4l2Sensor::State {
  State(const CameraAddress& address_, const CameraDescription& description_, VideoKernel& kernel_,
        const char* sys_root_, const char* dev_root_)
      : address(address_),
        description(description_),
        kernel(kernel_),
        sys_root(sys_root_),
        dev_root(dev_root_),
        name(address_.serial[0] != '\0' ? std::string("v4l2:serial=") + address_.serial
                                        : std::string("v4l2:") + address_.device),
        stream(kernel_, counters) {}

  CameraAddress address;
  CameraDescription description;
  VideoKernel& kernel;
  std::string sys_root;
  std::string dev_root;
  std::string name;  ///< For people.
  hal::SensorCounters counters;
  V4l2Stream stream;
  std::optional<VideoNode> known;  ///< The device that was opened first: only it is taken again.
  bool lost = false;
};

V4l2Sensor::V4l2Sensor(const CameraAddress& address, const CameraDescription& description,
                       VideoKernel& kernel, const char* sys_root, const char* dev_root)
    : state_(std::make_unique<State>(address, description, kernel, sys_root, dev_root)) {}

V4l2Sensor::~V4l2Sensor() { DoClose(); }

Fault V4l2Sensor::DoOpen() noexcept {
  State& state = *state_;
  if (state.stream.is_open()) return {};
  CameraDescription chosen;
  Fault fault = ChooseIntrinsics(state.address, state.description, chosen);
  VideoNode node;
  if (fault.ok()) {
    const CameraSearch search{state.kernel, state.address, state.sys_root, state.dev_root};
    fault = FindCamera(search, state.known, node);
  }
  if (fault.ok()) fault = state.stream.Open(node, state.address, chosen);
  if (!fault.ok()) return fault;
  if (state.lost) AddSaturating(state.counters.reconnects);
  state.lost = false;
  state.known = node;
  return {};
}

Fault V4l2Sensor::DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept {
  State& state = *state_;
  if (!state.stream.is_open()) {
    return hal::MakeFault(state.lost ? Status::kDeviceLost : Status::kNotOpen, "%s: %s",
                          state.name.c_str(), state.lost ? "the camera is gone" : "is not open");
  }
  const Fault fault = state.stream.Next(timeout_ns, frame);
  if (fault.status == Status::kDeviceLost) {
    state.stream.Close();
    state.lost = true;
  }
  return fault;
}

void V4l2Sensor::DoClose() noexcept { state_->stream.Close(); }

hal::SensorInfo V4l2Sensor::DoInfo() const noexcept {
  const StreamLayout& layout = state_->stream.layout();
  hal::SensorInfo info;
  info.name = state_->name.c_str();
  info.width_px = layout.width_px;
  info.height_px = layout.height_px;
  info.rate_hz = layout.rate_hz;
  info.live = true;
  info.stamp_point = state_->stream.stamp_point();
  info.held_frames = V4l2Stream::kHeldFrames;
  return info;
}

hal::SensorCounters V4l2Sensor::DoCounters() const noexcept { return state_->counters; }

int V4l2Sensor::Dmabuf(const DepthFrame& frame) const noexcept {
  return state_->stream.Dmabuf(frame.depth.data);
}

}  // namespace disflow::posix
