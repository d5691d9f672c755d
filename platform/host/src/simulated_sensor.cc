// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/simulated_sensor.h"

#include <utility>

namespace disflow::host {

SimulatedSensor::SimulatedSensor(const SimulationOptions& options, TriangleMesh mesh)
    : SimulatedSensor(options, std::vector<TriangleMesh>{std::move(mesh)}) {}

SimulatedSensor::SimulatedSensor(const SimulationOptions& options, std::vector<TriangleMesh> meshes)
    : simulation_(options, std::move(meshes)),
      name_("simulated " + ObjectName(options) + ", " + std::to_string(options.frames) +
            " frames") {}

hal::Fault SimulatedSensor::DoOpen() noexcept {
  if (open_) return {};
  open_ = true;
  next_ = 0;
  counters_ = {};
  return {};
}

hal::Fault SimulatedSensor::DoNext(std::int64_t /*timeout_ns*/, DepthFrame& frame) noexcept {
  if (!open_) {
    return hal::MakeFault(Status::kNotOpen, "%s: not open; call Open() first", name_.c_str());
  }
  const int frames = simulation_.options().frames;
  while (next_ < frames && simulation_.IsDropped(next_)) {
    ++next_;
    ++counters_.dropped;
  }
  if (next_ >= frames) {
    return hal::MakeFault(Status::kEndOfStream, "%s: the sequence is over", name_.c_str());
  }
  simulation_.Render(next_, frame);
  truth_ = simulation_.TruthAt(next_);
  ++next_;
  ++counters_.frames;
  return {};
}

void SimulatedSensor::DoClose() noexcept { open_ = false; }

hal::SensorInfo SimulatedSensor::DoInfo() const noexcept {
  const SimulationOptions& options = simulation_.options();
  return {.name = name_.c_str(),
          .width_px = options.width_px,
          .height_px = options.height_px,
          .rate_hz = static_cast<float>(options.fps),
          .live = false};
}

hal::SensorCounters SimulatedSensor::DoCounters() const noexcept { return counters_; }

}  // namespace disflow::host
