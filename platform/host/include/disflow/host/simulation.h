// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "disflow/host/camera_motion.h"
#include "disflow/host/depth_renderer.h"
#include "disflow/host/motion.h"
#include "disflow/host/occluding_arm.h"
#include "disflow/host/sensor_noise.h"
#include "disflow/host/simulation_options.h"
#include "disflow/host/sloppy_mask.h"
#include "disflow/host/touching_hand.h"
#include "disflow/host/triangle_mesh.h"

namespace disflow::host {

/// What really happens at a frame's capture time.
struct FrameTruth {
  StampNs stamp_ns = 0;
  RigidState<Camera, Object> object;  ///< T_co and the twist relative to the camera.
  RigidState<World, Camera> camera;   ///< World = first camera frame.
};

/// A moving object before a wall and a table top, seen by a depth camera. A pure function of the
/// options: any frame may be rendered in any order, only the sloppy mask needs increasing order.
class Simulation {
 public:
  static constexpr StampNs kFirstStamp_ns = 1'000'000'000;

  /// @param mesh The object, its origin about in its middle.
  Simulation(const SimulationOptions& options, TriangleMesh mesh);

  [[nodiscard]] FrameTruth TruthAt(int index) const;
  [[nodiscard]] bool IsDropped(int index) const {
    return dropped_[static_cast<std::size_t>(index)];
  }

  /// Takes image `index` (0 to frames - 1). The views stay valid until the next call.
  void Render(int index, DepthFrame& frame);

  /// Masks of the image rendered last.
  [[nodiscard]] MaskView gt_mask() const { return ViewOf(gt_mask_); }
  [[nodiscard]] MaskView sloppy_mask() const { return ViewOf(sloppy_.mask()); }

  [[nodiscard]] const SimulationOptions& options() const { return options_; }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const PinholeCamera& camera() const { return camera_; }

 private:
  void DrawScene(int index, const FrameTruth& truth);
  void DrawOccluder(double time_s, const FrameTruth& truth);
  [[nodiscard]] Plane TableAt(double time_s, const FrameTruth& truth) const;
  [[nodiscard]] DepthView DepthToDeliver();
  [[nodiscard]] MaskView ViewOf(std::span<const std::uint8_t> mask) const;

  SimulationOptions options_;
  TriangleMesh mesh_;
  PinholeCamera camera_;
  double radius_m_;
  Workspace workspace_;
  std::unique_ptr<const ObjectMotion> object_motion_;
  std::optional<CameraMotion> camera_motion_;
  std::optional<OccludingArm> arm_;
  std::optional<TouchingHand> hand_;
  DepthRenderer renderer_;
  std::optional<SensorNoise> noise_;
  SloppyMask sloppy_;
  std::vector<bool> dropped_;
  std::vector<float> depth_m_;
  std::vector<std::uint16_t> depth_mm_;
  std::vector<std::uint8_t> gt_mask_;
};

/// The mesh of a procedural object. @pre options.object is not kObjFile.
[[nodiscard]] TriangleMesh MakeObjectMesh(ObjectKind object);

}  // namespace disflow::host
