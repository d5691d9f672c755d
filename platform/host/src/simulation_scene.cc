// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "disflow/host/simulation.h"
#include "scene_label.h"

/// @file
/// What the simulated camera has before it.

namespace disflow::host {
namespace {

constexpr double kGapBehindObject_m = 0.35;

Plane SeenFromEye(const Plane& plane, const Vec3d& eye_m) {
  return {plane.normal, plane.offset_m - plane.normal.dot(eye_m)};
}

Transform<Camera, Object, double> SeenFromEye(const Transform<Camera, Object, double>& T_co,
                                              const Vec3d& eye_m) {
  return {T_co.rotation(), Vec3d(T_co.translation() - eye_m)};
}

/// Of the mesh's points, how far the lowest is up.
template <class Frame>
double LowestAlong(const Vec3d& up, const TriangleMesh& mesh,
                   const Transform<Frame, Object, double>& pose) {
  double lowest_m = std::numeric_limits<double>::max();
  for (const Vec3d& vertex : mesh.vertices) lowest_m = std::min(lowest_m, up.dot(pose * vertex));
  return lowest_m;
}

}  // namespace

void Simulation::DrawScene(int index, const Vec3d& eye_m, DepthRenderer& renderer) const {
  const FrameTruth truth = TruthAt(index);
  double wall_m = 1.5;
  double table_m = 0.33;
  for (const Body& body : bodies_) {
    const Workspace& space = body.workspace;
    wall_m = std::max(
        wall_m, space.centre_m.z() + space.half_extent_m.z() + body.radius_m + kGapBehindObject_m);
    table_m = std::max(table_m, space.half_extent_m.y() + body.radius_m + 0.1);
  }
  // A slanted wall and a table top, fixed in the world.
  const std::array<Plane, 2> planes{
      Plane{Vec3d(0.25, 0.0, 1.0).normalized(), wall_m * Vec3d(0.25, 0.0, 1.0).normalized().z()},
      Plane{Vec3d(0.0, 1.0, -0.02).normalized(), table_m}};
  const Mat3d& R_wc = truth.camera.pose.rotation();
  renderer.Clear();
  for (const Plane& plane : planes) {
    renderer.DrawPlane(
        SeenFromEye({Vec3d(R_wc.transpose() * plane.normal),
                     plane.offset_m - plane.normal.dot(truth.camera.pose.translation())},
                    eye_m));
  }
  const double time_s = index / options_.fps;
  if (options_.support == SupportKind::kTable)
    renderer.DrawPlane(SeenFromEye(TableAt(time_s, truth), eye_m));
  DrawBodies(index, eye_m, renderer);
  DrawOccluder(time_s, truth, eye_m, renderer);
}

void Simulation::DrawBodies(int index, const Vec3d& eye_m, DepthRenderer& renderer) const {
  constexpr double kGone_s = 1.0;
  constexpr double kBack_s = 2.0;
  const double time_s = index / options_.fps;
  const bool hides = time_s >= kGone_s && time_s < kBack_s;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const std::size_t number = i + 1;
    if (hides && static_cast<std::size_t>(options_.hide) == number) continue;
    renderer.DrawMesh(bodies_[i].mesh, SeenFromEye(TruthAt(index, i).object.pose, eye_m),
                      SceneLabel::kFirstObject + static_cast<std::uint32_t>(i));
  }
}

void Simulation::DrawOccluder(double time_s, const FrameTruth& truth, const Vec3d& eye_m,
                              DepthRenderer& renderer) const {
  if (arm_) {
    renderer.DrawMesh(arm_->mesh(), SeenFromEye(arm_->PoseAt(time_s, truth.object.pose), eye_m),
                      SceneLabel::kOccluder);
  }
  if (hand_) {
    renderer.DrawMesh(hand_->mesh(), SeenFromEye(hand_->PoseAt(time_s, truth.object.pose), eye_m),
                      SceneLabel::kOccluder);
  }
  constexpr double kCurtainDown_s = 1.0;
  constexpr double kCurtainUp_s = 1.5;
  if (options_.occluder == OccluderKind::kCurtain && time_s >= kCurtainDown_s &&
      time_s < kCurtainUp_s) {
    constexpr double kCurtain_m = 0.3;
    renderer.DrawPlane(SeenFromEye({Vec3d::UnitZ(), kCurtain_m}, eye_m), SceneLabel::kOccluder);
  }
}

/// Which way the table is up, in the world: of the axes of the first object as it starts the one
/// nearest to the camera's upward direction, of those that leave the camera above the table.
Vec3d Simulation::UpFromTable() const {
  // The camera starts at the world's origin, and its y axis points down.
  const auto& start = bodies_.front().motion->At(0.0).pose;
  std::pair<bool, double> best{false, -std::numeric_limits<double>::max()};
  Vec3d best_up = -Vec3d::UnitY();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Vec3d up = sign * start.rotation().col(axis);
      const double lowest_m = LowestAlong(up, bodies_.front().mesh, start);
      const std::pair<bool, double> how_well{lowest_m < 0.0, -up.y()};
      if (how_well <= best) continue;
      best = how_well;
      best_up = up;
    }
  }
  return best_up;
}

/// Below the object's lowest point, whatever its attitude; camera frame.
Plane Simulation::TableAt(double time_s, const FrameTruth& truth) const {
  constexpr double kLiftOff_s = 1.0;
  constexpr double kLift_mps = 0.3;
  // Level with the object's start in the world.
  const Vec3d up = truth.camera.pose.rotation().transpose() * table_up_;
  const double lowest_m = LowestAlong(up, bodies_.front().mesh, truth.object.pose);
  return {up, lowest_m - kLift_mps * std::max(0.0, time_s - kLiftOff_s)};
}

/// What paint is fixed to: the room, each object, an arm or a hand.
void Simulation::PlaceSurfaces(int index) {
  const FrameTruth truth = TruthAt(index);
  const double time_s = index / options_.fps;
  // Other frames' names, the same numbers.
  const Transform<Object, Camera, double> room(truth.camera.pose.rotation(),
                                               truth.camera.pose.translation());
  surfaces_.clear();
  surfaces_.push_back({SceneLabel::kBackground, room});
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    surfaces_.push_back({SceneLabel::kFirstObject + static_cast<std::uint32_t>(i),
                         TruthAt(index, i).object.pose.Inverse()});
  }
  auto occluder = Transform<Camera, Object, double>();
  if (arm_) occluder = arm_->PoseAt(time_s, truth.object.pose);
  if (hand_) occluder = hand_->PoseAt(time_s, truth.object.pose);
  surfaces_.push_back({SceneLabel::kOccluder, occluder.Inverse()});
}

}  // namespace disflow::host
