// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "disflow.h"
#include "disflow/config.h"
#include "disflow/depth/depth_frame.h"
#include "disflow/estimate.h"
#include "disflow/surface_extractor.h"

/// @file
/// What stands behind the opaque names of disflow.h.

// NOLINTBEGIN(readability-identifier-naming): as disflow.h declares them.
/// A tracker whose profile is known at run time. Lies at the start of the caller's memory.
struct disflow_tracker {
  disflow_tracker() = default;
  disflow_tracker(const disflow_tracker&) = delete;
  disflow_tracker& operator=(const disflow_tracker&) = delete;

  virtual void Process(const disflow::DepthFrame& frame, disflow::Estimate& estimate) noexcept = 0;
  virtual void Fuse(const disflow::DepthFrame& frame, const disflow::PoseObjectFromCamera& T_oc,
                    disflow::Estimate& estimate) noexcept = 0;
  virtual void Reset() noexcept = 0;
  virtual disflow::Status Choose(const disflow::ObjectStart& start) noexcept = 0;
  /// 255 where the row's pixel showed the object, else 0.
  virtual void WriteMaskRow(int v, std::span<std::uint8_t> row) const noexcept = 0;
  /// @param workspace Large enough.
  virtual disflow::Status ExtractSurface(const disflow::SurfaceOptions& options, void* workspace,
                                         disflow::TriangleSink& sink) const noexcept = 0;
  virtual int StreamSamples(disflow::SampleSink& sink) const noexcept = 0;
  virtual disflow::Status Query(const float* points_m, int point_count, float support_radius_m,
                                void* workspace, disflow_distance* distances) const noexcept = 0;
  [[nodiscard]] virtual std::size_t workspace_bytes() const noexcept = 0;

 protected:
  ~disflow_tracker() = default;
};

struct disflow_profile {
  const char* name;
  std::size_t tracker_bytes;
  std::size_t workspace_bytes;
  std::int32_t max_width_px;
  std::int32_t max_height_px;
  /// @param memory Large enough and aligned.
  disflow_tracker* (*make)(void* memory, const disflow::Config& config) noexcept;
};
// NOLINTEND(readability-identifier-naming)

namespace disflow::c {

/// Memory that is handed over is at multiples of this.
inline constexpr std::size_t kAlignment = 8;

[[nodiscard]] inline bool IsAligned(const void* memory) noexcept {
  return reinterpret_cast<std::uintptr_t>(memory) % kAlignment == 0;
}

}  // namespace disflow::c
