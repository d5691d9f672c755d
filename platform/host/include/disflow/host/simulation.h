// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "disflow/host/camera_motion.h"
#include "disflow/host/depth_camera.h"
#include "disflow/host/depth_renderer.h"
#include "disflow/host/mask_disturbance.h"
#include "disflow/host/motion.h"
#include "disflow/host/occluding_arm.h"
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

/// Moving objects before a wall and a table top, seen by a depth camera. A pure function of the
/// options: any frame may be rendered in any order, only the sloppy mask needs increasing order.
/// Several objects move one behind the other, each in its own way; occluders and supports are those
/// of the first.
class Simulation {
 public:
  static constexpr StampNs kFirstStamp_ns = 1'000'000'000;

  /// @param mesh The object, its origin about in its middle.
  Simulation(const SimulationOptions& options, TriangleMesh mesh);
  /// @param meshes One per object of the options.
  Simulation(const SimulationOptions& options, std::vector<TriangleMesh> meshes);

  /// @param object From 0, the nearest first.
  [[nodiscard]] FrameTruth TruthAt(int index, std::size_t object = 0) const;
  [[nodiscard]] bool IsDropped(int index) const {
    return dropped_[static_cast<std::size_t>(index)];
  }

  /// Takes image `index` (0 to frames - 1). The views stay valid until the next call.
  void Render(int index, DepthFrame& frame);

  /// Whether the image is the one before again, under a stamp of its own.
  [[nodiscard]] bool IsRepeated(int index) const {
    return repeated_[static_cast<std::size_t>(index)];
  }

  /// Masks of the image rendered last: 255, or with several objects the number of each from 1 on.
  [[nodiscard]] MaskView gt_mask() const { return ViewOf(gt_mask_); }
  [[nodiscard]] MaskView sloppy_mask() const { return ViewOf(sloppy_mask_); }
  /// What the frame brings: of the kind that the options name, with all that goes wrong with it. No
  /// data where it is missing.
  [[nodiscard]] MaskView mask() const;
  /// Whether anything goes wrong with the masks but what SloppyMask does.
  [[nodiscard]] bool HasDisturbedMask() const;

  /// The left infrared image of the image rendered last; no data unless the camera has one.
  [[nodiscard]] MaskView infrared() const { return ViewOf(depth_camera_->infrared()); }

  [[nodiscard]] const SimulationOptions& options() const { return options_; }
  [[nodiscard]] std::size_t objects() const { return bodies_.size(); }
  [[nodiscard]] const TriangleMesh& mesh(std::size_t object = 0) const {
    return bodies_[object].mesh;
  }
  [[nodiscard]] const PinholeCamera& camera() const { return camera_; }

 private:
  struct Body {
    TriangleMesh mesh;
    double radius_m = 0.0;
    Workspace workspace;
    std::unique_ptr<const ObjectMotion> motion;
    SloppyMask sloppy;
    MaskDisturbance disturbance;
  };

  [[nodiscard]] static std::vector<Body> MakeBodies(const SimulationOptions& options,
                                                    std::vector<TriangleMesh> meshes);
  /// @param eye_m Where it is seen from, in the camera's frame.
  void DrawScene(int index, const Vec3d& eye_m, DepthRenderer& renderer) const;
  void DrawBodies(int index, const Vec3d& eye_m, DepthRenderer& renderer) const;
  void DrawOccluder(double time_s, const FrameTruth& truth, const Vec3d& eye_m,
                    DepthRenderer& renderer) const;
  void PlaceSurfaces(int index);
  void DrawMasks(int index);
  void DisturbMasks(int index);
  [[nodiscard]] int SourceOf(int index) const;
  [[nodiscard]] bool IsBlank(int index) const;
  void Blank();
  [[nodiscard]] Vec3d UpFromTable() const;
  [[nodiscard]] Plane TableAt(double time_s, const FrameTruth& truth) const;
  [[nodiscard]] DepthView DepthToDeliver();
  [[nodiscard]] MaskView ViewOf(std::span<const std::uint8_t> mask) const;

  SimulationOptions options_;
  PinholeCamera camera_;
  std::vector<Body> bodies_;
  std::optional<CameraMotion> camera_motion_;
  Vec3d table_up_ = -Vec3d::UnitY();  ///< World.
  std::optional<OccludingArm> arm_;
  std::optional<TouchingHand> hand_;
  DepthRenderer renderer_;
  std::unique_ptr<DepthCamera> depth_camera_;
  std::optional<DepthRenderer> late_;  ///< What late masks show.
  std::vector<bool> dropped_;
  std::vector<bool> repeated_;
  std::vector<StampNs> jitter_ns_;
  std::vector<float> depth_m_;
  std::vector<std::uint16_t> depth_mm_;
  std::vector<PaintedSurface>
      surfaces_;  ///< Of the frame shown; kept, so that frames allocate nothing.
  std::vector<std::uint8_t> gt_mask_;
  std::vector<std::uint8_t> sloppy_mask_;
  std::vector<std::uint8_t> disturbed_mask_;
  bool mask_missing_ = false;
  std::vector<std::uint8_t> exact_;  ///< Mask of one object.
};

}  // namespace disflow::host
