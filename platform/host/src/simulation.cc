// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "disflow/host/object_meshes.h"
#include "disflow/host/random.h"
#include "smooth_motion.h"

namespace disflow::host {
namespace {

enum Label : std::uint32_t { kBackground = 0, kObject = 1, kOccluder = 2 };

constexpr double kGapBehindObject_m = 0.35;

/// Turns the mesh's longest side upright; then the front towards the camera and the top into view.
Mat3d StartRotation(const SimulationOptions& options, const TriangleMesh& mesh) {
  Mat3d rotation;
  rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // +z up: the camera's y axis points down
  double tilt_rad = 25.0 * kRadPerDeg;
  if (options.object == ObjectKind::kDoughnut) tilt_rad = 50.0 * kRadPerDeg;
  if (options.object == ObjectKind::kObjFile) {
    Vec3d extent = Vec3d::Zero();
    for (const Vec3d& vertex : mesh.vertices) extent = extent.cwiseMax(vertex.cwiseAbs());
    int longest = 0;
    extent.maxCoeff(&longest);
    if (longest == 0) rotation *= ExpSo3(Vec3d(0.0, -0.5 * std::numbers::pi, 0.0));
    // Tall meshes with a y axis along their height have it point down, as Fast-YCB's do.
    if (longest == 1) rotation *= ExpSo3(Vec3d(-0.5 * std::numbers::pi, 0.0, 0.0));
  }
  RandomNumbers random(options.seed, 5);
  const double yaw_rad = random.Uniform(25.0, 65.0) * kRadPerDeg;
  return ExpSo3(Vec3d(tilt_rad, 0.0, 0.0)) * ExpSo3(Vec3d(0.0, yaw_rad, 0.0)) * rotation;
}

std::vector<bool> ChooseDropped(const SimulationOptions& options) {
  RandomNumbers random(options.seed, 6);
  std::vector<bool> dropped(static_cast<std::size_t>(options.frames));
  for (std::size_t i = 1; i < dropped.size(); ++i) dropped[i] = random.Uniform() < options.drop;
  return dropped;
}

std::optional<SensorNoise> MakeNoise(const SimulationOptions& options) {
  if (options.noise == NoiseKind::kClean) return std::nullopt;
  const auto fx_px = static_cast<double>(SimulatedCamera(options).fx_px);
  return SensorNoise(options.noise == NoiseKind::kD415 ? D415Model(fx_px) : KinectModel(),
                     options.width_px, options.height_px, options.seed);
}

}  // namespace

Simulation::Simulation(const SimulationOptions& options, TriangleMesh mesh)
    : options_(options),
      mesh_(std::move(mesh)),
      camera_(SimulatedCamera(options)),
      radius_m_(BoundingRadius(mesh_)),
      workspace_(FitWorkspace(
          camera_, options.width_px, options.height_px,
          radius_m_ + (options.camera == CameraKind::kMoving ? CameraMotion::kViewMargin_m : 0.0))),
      object_motion_(MakeObjectMotion({.kind = options.motion,
                                       .workspace = workspace_,
                                       .start_rotation = StartRotation(options, mesh_),
                                       .duration_s = options.frames / options.fps,
                                       .frame_period_s = 1.0 / options.fps,
                                       .seed = options.seed})),
      renderer_(camera_, options.width_px, options.height_px),
      noise_(MakeNoise(options)),
      sloppy_(options.width_px, options.height_px),
      dropped_(ChooseDropped(options)),
      depth_m_(renderer_.labels().size()),
      depth_mm_(options.format == DepthFormat::kUint16 ? depth_m_.size() : 0),
      gt_mask_(depth_m_.size()) {
  if (options.camera == CameraKind::kMoving) {
    camera_motion_.emplace(workspace_.centre_m.z(), options.seed);
  }
  if (options.occluder == OccluderKind::kArm) arm_.emplace(radius_m_, options.seed);
  if (options.occluder == OccluderKind::kHand)
    hand_.emplace(mesh_, TruthAt(0).object.pose.rotation());
}

FrameTruth Simulation::TruthAt(int index) const {
  const double time_s = index / options_.fps;
  FrameTruth truth;
  // Not zero: a stamp of zero means "not set" to some programs.
  truth.stamp_ns = kFirstStamp_ns + std::llround(time_s * 1e9);
  if (camera_motion_) truth.camera = camera_motion_->At(time_s);
  truth.object = SeenFrom(truth.camera, object_motion_->At(time_s));
  return truth;
}

void Simulation::DrawScene(int index, const FrameTruth& truth) {
  const double wall_m = std::max(
      1.5, workspace_.centre_m.z() + workspace_.half_extent_m.z() + radius_m_ + kGapBehindObject_m);
  // A slanted wall and a table top, fixed in the world.
  const std::array<Plane, 2> planes{
      Plane{Vec3d(0.25, 0.0, 1.0).normalized(), wall_m * Vec3d(0.25, 0.0, 1.0).normalized().z()},
      Plane{Vec3d(0.0, 1.0, -0.02).normalized(),
            std::max(0.33, workspace_.half_extent_m.y() + radius_m_ + 0.1)}};
  const Mat3d& R_wc = truth.camera.pose.rotation();
  renderer_.Clear();
  for (const Plane& plane : planes) {
    renderer_.DrawPlane({Vec3d(R_wc.transpose() * plane.normal),
                         plane.offset_m - plane.normal.dot(truth.camera.pose.translation())});
  }
  const double time_s = index / options_.fps;
  if (options_.support == SupportKind::kTable) renderer_.DrawPlane(TableAt(time_s, truth));
  renderer_.DrawMesh(mesh_, truth.object.pose, kObject);
  DrawOccluder(time_s, truth);
}

void Simulation::DrawOccluder(double time_s, const FrameTruth& truth) {
  if (arm_) renderer_.DrawMesh(arm_->mesh(), arm_->PoseAt(time_s, truth.object.pose), kOccluder);
  if (hand_) renderer_.DrawMesh(hand_->mesh(), hand_->PoseAt(time_s, truth.object.pose), kOccluder);
  constexpr double kCurtainDown_s = 1.0;
  constexpr double kCurtainUp_s = 1.5;
  if (options_.occluder == OccluderKind::kCurtain && time_s >= kCurtainDown_s &&
      time_s < kCurtainUp_s) {
    constexpr double kCurtain_m = 0.3;
    renderer_.DrawPlane({Vec3d::UnitZ(), kCurtain_m}, kOccluder);
  }
}

/// Below the object's lowest point, whatever its attitude; camera frame.
Plane Simulation::TableAt(double time_s, const FrameTruth& truth) const {
  constexpr double kLiftOff_s = 1.0;
  constexpr double kLift_mps = 0.3;
  // Level with the object's start in the world.
  const Vec3d up = truth.camera.pose.rotation().transpose() *
                   object_motion_->At(0.0).pose.rotation() * Vec3d::UnitZ();
  double lowest_m = std::numeric_limits<double>::max();
  for (const Vec3d& vertex : mesh_.vertices)
    lowest_m = std::min(lowest_m, up.dot(truth.object.pose * vertex));
  return {up, lowest_m - kLift_mps * std::max(0.0, time_s - kLiftOff_s)};
}

void Simulation::Render(int index, DepthFrame& frame) {
  const FrameTruth truth = TruthAt(index);
  DrawScene(index, truth);
  const std::span<const float> inverse_depth = renderer_.inverse_depth_per_m();
  if (noise_) {
    noise_->Apply(index, inverse_depth, depth_m_);
  } else {
    std::transform(inverse_depth.begin(), inverse_depth.end(), depth_m_.begin(),
                   [](float w) { return w > 0.0F ? 1.0F / w : 0.0F; });
  }
  std::transform(
      renderer_.labels().begin(), renderer_.labels().end(), gt_mask_.begin(),
      [](std::uint32_t label) { return static_cast<std::uint8_t>(label == kObject ? 255 : 0); });
  sloppy_.Update(index, gt_mask_);

  frame = DepthFrame{};
  frame.depth = DepthToDeliver();
  frame.camera = camera_;
  frame.stamp_ns = truth.stamp_ns;
  if (options_.mask == MaskKind::kGt) frame.mask = gt_mask();
  if (options_.mask == MaskKind::kSloppy) frame.mask = sloppy_mask();
  frame.has_T_wc = camera_motion_.has_value();
  if (frame.has_T_wc) frame.T_wc = truth.camera.pose.Cast<float>();
}

DepthView Simulation::DepthToDeliver() {
  DepthView view;
  view.width_px = options_.width_px;
  view.height_px = options_.height_px;
  view.format = options_.format;
  if (options_.format == DepthFormat::kFloat32) {
    view.data = depth_m_.data();
  } else {
    constexpr float kMaxUnits = 65535.0F;
    std::transform(depth_m_.begin(), depth_m_.end(), depth_mm_.begin(), [](float depth_m) {
      const float units = std::round(depth_m * 1000.0F);
      return static_cast<std::uint16_t>(units <= kMaxUnits ? units : 0.0F);
    });
    view.data = depth_mm_.data();
  }
  view.stride_bytes = static_cast<std::ptrdiff_t>(view.width_px) * view.bytes_per_pixel();
  return view;
}

MaskView Simulation::ViewOf(std::span<const std::uint8_t> mask) const {
  return {mask.data(), options_.width_px, options_.height_px, options_.width_px};
}

TriangleMesh MakeObjectMesh(ObjectKind object) {
  switch (object) {
    case ObjectKind::kBox:
      return MakeCrackerBox();
    case ObjectKind::kBottle:
      return MakeMustardBottle();
    case ObjectKind::kCan:
      return MakeCan();
    case ObjectKind::kDoughnut:
      return MakeDoughnut();
    case ObjectKind::kObjFile:
      break;
  }
  return {};
}

}  // namespace disflow::host
