// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "disflow/distance_flow.h"

namespace disflow::apps {

/// Collects the streamed distance flow of one frame.
class FlowCloud final : public FlowSink {
 public:
  /// The colours' scale: the brightest stands for this speed and all above.
  static constexpr float kBrightest_mps = 0.5F;

  /// So that as many samples come without an allocation.
  void Reserve(std::size_t samples) { samples_.reserve(samples); }
  void Clear() noexcept { samples_.clear(); }
  [[nodiscard]] const std::vector<FlowSample>& samples() const noexcept { return samples_; }

  /// @return Binary PLY, camera frame: x y z nx ny nz red green blue distance_m gx gy gz vx vy vz.
  [[nodiscard]] std::string FormatPly(const Estimate& estimate) const;

 private:
  void DoOnSample(const FlowSample& sample) noexcept override { samples_.push_back(sample); }

  std::vector<FlowSample> samples_;
};

}  // namespace disflow::apps
