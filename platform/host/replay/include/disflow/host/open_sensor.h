// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "disflow/hal/depth_sensor.h"
#include "disflow/host/simulated_sensor.h"

namespace disflow::host {

/// A sensor made from its address; holds whichever kind it is.
class Sensor {
 public:
  /// The sensor, not null after OpenSensor() said ok.
  [[nodiscard]] hal::DepthSensor* get() const { return sensor_.get(); }
  /// The same if it is a simulated one, which knows the truth; else null.
  [[nodiscard]] SimulatedSensor* simulated() const { return simulated_; }

  /// What people should know of it although it could be opened; usually empty.
  [[nodiscard]] const std::string& note() const { return note_; }

  template <class Kind, class... Arguments>
  Kind& Emplace(Arguments&&... arguments) {
    auto made = std::make_shared<Kind>(std::forward<Arguments>(arguments)...);
    Kind& reference = *made;
    // A shared pointer remembers how to delete Kind; DepthSensor has no virtual destructor.
    sensor_ = std::move(made);
    return reference;
  }
  void set_simulated(SimulatedSensor* sensor) { simulated_ = sensor; }
  void set_note(std::string note) { note_ = std::move(note); }

 private:
  std::shared_ptr<hal::DepthSensor> sensor_;
  SimulatedSensor* simulated_ = nullptr;
  std::string note_;
};

/// Makes and opens the sensor that an address names: `replay:DIR?…` or `sim:OBJECT?…`.
/// @return kInvalidUri for an unknown scheme, key or value; else what opening says.
[[nodiscard]] hal::Fault OpenSensor(std::string_view address, Sensor& sensor);

/// All addresses and their options, for --help.
[[nodiscard]] std::string SensorHelp();

}  // namespace disflow::host
