// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "disflow/host/simulation_options.h"

namespace disflow::host {

/// What goes wrong with one object's mask: it leaks, is too large or too small, or flickers.
/// Depends on the seed, the frame's number and the mask only.
class MaskDisturbance {
 public:
  /// @param object From 0; every object's masks fail by themselves.
  MaskDisturbance(const SimulationOptions& options, std::size_t object);

  /// @param labels What each pixel shows; others than the background are leaked into first.
  /// @param mask 255 = object; changed in place.
  /// @return False if the mask of this frame is missing.
  [[nodiscard]] bool Apply(int frame, std::span<const std::uint32_t> labels,
                           std::vector<std::uint8_t>& mask);

 private:
  struct Extent {
    double u = 0.0;  ///< Centre.
    double v = 0.0;
    double radius = 0.0;
  };
  [[nodiscard]] Extent ExtentOf(std::span<const std::uint8_t> mask) const;
  void Leak(int frame, std::span<const std::uint32_t> labels,
            std::vector<std::uint8_t>& mask) const;
  void CutOff(double angle_rad, std::vector<std::uint8_t>& mask) const;

  SimulationOptions options_;
  std::uint64_t seed_;
  std::vector<std::uint8_t> rows_;
};

}  // namespace disflow::host
