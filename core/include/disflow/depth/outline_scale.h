// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace disflow {

/// What shows where the object ends.
enum class OutlineSource : std::uint8_t { kDepth, kMask };

/// The outline that a frame's edges were taken from.
struct SampledOutline {
  OutlineSource source = OutlineSource::kDepth;
  float std_px = 0.0F;  ///< How far it is off, as far as that is known.
};

/// How many times farther off outlines are than their raggedness tells. A camera that matches
/// windows of pixels moves whole stretches of an outline alike, which no look at the outline shows;
/// how far a frame's edges are off the model's does. Of depth and of masks apart: they err
/// otherwise.
class OutlineScale {
 public:
  [[nodiscard]] float Of(OutlineSource source) const noexcept {
    return scale_[static_cast<std::size_t>(source)];
  }

  /// Takes over what a frame's registered edges told.
  /// @param deviations Their spread in their standard deviations as they were taken for true, see
  ///     SpreadOf(); what is not positive says nothing.
  void Learn(OutlineSource source, float deviations) noexcept;

 private:
  std::array<float, 2> scale_ = {1.0F, 1.0F};  ///< At least 1, by source.
};

}  // namespace disflow
