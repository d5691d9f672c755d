// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "disflow.h"
#include "traced_scene.h"

namespace disflow::testing {

/// A box that moves and turns steadily before a wall.
inline DepthScene BoxAt(float t) {
  const Vec3 rate_rps(0.2F, 0.8F, -0.3F);
  const Vec3 velocity_mps(0.15F, 0.05F, 0.1F);
  const PoseCameraFromObject T_co(Mat3(ExpSo3(Vec3(t * rate_rps)) * ExpSo3(Vec3(0.5F, 0.6F, 0.1F))),
                                  Vec3(Vec3(-0.03F, 0.0F, 0.42F) + t * velocity_mps));
  DepthScene scene(1.2F);
  return Trace(Box(Vec3(0.07F, 0.05F, 0.06F), 0.0F), T_co, scene);
}

inline std::int64_t StampOf(int frame) { return 1'000'000'000 + std::int64_t{33'333'333} * frame; }

/// The same frame as C has it. Zeros stand for what follows from the rest.
inline disflow_frame InC(const DepthFrame& frame) {
  disflow_frame c{};
  c.depth = frame.depth.data;
  c.depth_format = DISFLOW_DEPTH_FLOAT32;
  c.width_px = frame.depth.width_px;
  c.height_px = frame.depth.height_px;
  c.fx_px = frame.camera.fx_px;
  c.fy_px = frame.camera.fy_px;
  c.cx_px = frame.camera.cx_px;
  c.cy_px = frame.camera.cy_px;
  c.stamp_ns = frame.stamp_ns;
  c.mask = frame.mask.data;
  return c;
}

/// A tracker of the C interface in memory of its own.
class TrackerInC {
 public:
  explicit TrackerInC(const disflow_profile& profile = disflow_micro)
      : memory_(disflow_tracker_bytes(&profile) / 8 + 1),
        workspace_(disflow_workspace_bytes(&profile) / 8 + 1) {
    (void)disflow_create(&profile, memory_.data(), 8 * memory_.size(), nullptr, 0, &tracker_,
                         nullptr);
  }
  [[nodiscard]] disflow_tracker* get() { return tracker_; }
  [[nodiscard]] void* workspace() { return workspace_.data(); }
  [[nodiscard]] std::size_t workspace_bytes() const { return 8 * workspace_.size(); }

 private:
  std::vector<std::uint64_t> memory_;
  std::vector<std::uint64_t> workspace_;
  disflow_tracker* tracker_ = nullptr;
};

}  // namespace disflow::testing
