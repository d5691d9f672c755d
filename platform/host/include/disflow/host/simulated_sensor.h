// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "disflow/hal/depth_sensor.h"
#include "disflow/host/simulation.h"

namespace disflow::host {

/// The simulated camera as a depth sensor: renders one image per Next().
class SimulatedSensor final : public hal::DepthSensor {
 public:
  SimulatedSensor(const SimulationOptions& options, TriangleMesh mesh);
  /// @param meshes One per object of the options.
  SimulatedSensor(const SimulationOptions& options, std::vector<TriangleMesh> meshes);

  /// Of the frame that Next() delivered last; of the first object.
  [[nodiscard]] const FrameTruth& truth() const { return truth_; }
  [[nodiscard]] const Simulation& simulation() const { return simulation_; }

 private:
  hal::Fault DoOpen() noexcept override;
  hal::Fault DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept override;
  void DoClose() noexcept override;
  [[nodiscard]] hal::SensorInfo DoInfo() const noexcept override;
  [[nodiscard]] hal::SensorCounters DoCounters() const noexcept override;

  Simulation simulation_;
  std::string name_;
  FrameTruth truth_;
  hal::SensorCounters counters_;
  int next_ = 0;
  bool open_ = false;
};

}  // namespace disflow::host
