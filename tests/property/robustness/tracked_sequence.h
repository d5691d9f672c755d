// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"
#include "disflow/tracker.h"

namespace disflow::testing {

using EdgeTracker = Tracker<profiles::Edge>;

/// One frame: what the tracker said and how far that is from the truth.
struct TrackedFrame {
  int index = 0;
  Estimate estimate;
  Transform<Camera, Object, double> T_claimed;  ///< Of the simulated object's own frame.
  double off_m = 0.0;
  double off_deg = 0.0;
  /// From the nearest pose at which the object looks as at the true one: boxes do when turned over.
  double off_from_alike_deg = 0.0;
};

/// A simulated sequence and the tracker that follows it. The object frame is tied to the true one
/// at the first frame and again whenever the tracker starts anew.
class TrackedSequence {
 public:
  /// What happens to an image before the tracker gets it.
  enum class Fate : std::uint8_t { kSeen, kDropped, kBlank };

  /// @param size By how much the object is larger than its kind is drawn.
  explicit TrackedSequence(const host::SimulationOptions& options, const Config& config = {},
                           double size = 1.0)
      : simulation_(options, MeshOf(options.object, size)),
        tracker_(std::make_unique<EdgeTracker>(config)),
        blank_(static_cast<std::size_t>(options.width_px) *
                   static_cast<std::size_t>(options.height_px),
               0.0F) {}

  /// Tracks frames [0, count).
  void Run(
      int count, const std::function<Fate(int)>& fate = [](int) { return Fate::kSeen; }) {
    for (int i = 0; i < count; ++i) {
      if (fate(i) == Fate::kDropped) continue;
      DepthFrame frame;
      simulation_.Render(i, frame);
      if (fate(i) == Fate::kBlank) frame.depth.data = blank_.data();
      Process(i, frame);
    }
  }

  /// A frame of something else.
  Estimate Offer(const DepthFrame& frame) {
    Estimate estimate;
    (void)tracker_->Process(frame, estimate);
    return estimate;
  }

  [[nodiscard]] const std::vector<TrackedFrame>& frames() const { return frames_; }
  [[nodiscard]] const TrackedFrame& At(int index) const {
    return *std::find_if(frames_.begin(), frames_.end(),
                         [&](const TrackedFrame& frame) { return frame.index == index; });
  }
  [[nodiscard]] const TrackedFrame& last() const { return frames_.back(); }
  [[nodiscard]] bool WasEver(TrackingState state) const {
    return std::any_of(frames_.begin(), frames_.end(),
                       [&](const TrackedFrame& frame) { return frame.estimate.state == state; });
  }
  [[nodiscard]] host::FrameTruth Truth(int index) const { return simulation_.TruthAt(index); }
  [[nodiscard]] const EdgeTracker& tracker() const { return *tracker_; }
  [[nodiscard]] const host::Simulation& simulation() const { return simulation_; }
  /// From the tracker's object frame into the simulated object's own.
  [[nodiscard]] Transform<Object, Object, double> T_true() const { return tie_.Inverse(); }

  /// Most frames in a row that were called "tracking" with a pose off by more than 2 cm or 10
  /// degrees.
  /// @param turn_deg Which turn counts.
  [[nodiscard]] int LongestLie(double TrackedFrame::*turn_deg = &TrackedFrame::off_deg) const {
    int longest = 0;
    int lie = 0;
    for (const TrackedFrame& frame : frames_) {
      const bool off = frame.off_m > 0.02 || frame.*turn_deg > 10.0;
      lie = off && frame.estimate.state == TrackingState::kTracking ? lie + 1 : 0;
      longest = std::max(longest, lie);
    }
    return longest;
  }

 private:
  [[nodiscard]] static host::TriangleMesh MeshOf(host::ObjectKind object, double size) {
    host::TriangleMesh mesh = host::MakeObjectMesh(object);
    for (host::Vec3d& vertex_m : mesh.vertices) vertex_m *= size;
    return mesh;
  }

  void Process(int index, const DepthFrame& frame) {
    TrackedFrame result;
    result.index = index;
    (void)tracker_->Process(frame, result.estimate);
    const auto truth = simulation_.TruthAt(index).object.pose;
    const Transform<Camera, Object, double> said(
        result.estimate.T_co.rotation().cast<double>(),
        host::Vec3d(result.estimate.T_co.translation().cast<double>()));
    if (result.estimate.status == Status::kOk &&
        (!tied_ || result.estimate.reset_counter != counter_)) {
      tie_ = said.Inverse() * truth;
      tied_ = true;
      counter_ = result.estimate.reset_counter;
    }
    result.T_claimed = said * tie_;
    result.off_m = (result.T_claimed.translation() - truth.translation()).norm();
    const auto turn_deg = [&](const Mat<double, 3, 3>& rotation) {
      return TurnBetween(rotation, result.T_claimed.rotation()).norm() * 180.0 / std::numbers::pi;
    };
    result.off_deg = turn_deg(truth.rotation());
    result.off_from_alike_deg = result.off_deg;
    if (simulation_.options().object == host::ObjectKind::kBox) {
      for (int axis = 0; axis < 3; ++axis) {
        host::Vec3d half_turn = host::Vec3d::Constant(-1.0);
        half_turn[axis] = 1.0;
        result.off_from_alike_deg =
            std::min(result.off_from_alike_deg,
                     turn_deg(Mat<double, 3, 3>(truth.rotation() * half_turn.asDiagonal())));
      }
    }
    frames_.push_back(result);
  }

  host::Simulation simulation_;
  std::unique_ptr<EdgeTracker> tracker_;
  std::vector<float> blank_;
  std::vector<TrackedFrame> frames_;
  Transform<Object, Object, double> tie_;
  bool tied_ = false;
  std::uint8_t counter_ = 0;
};

/// A hand-held object, a common depth camera's noise, 30 frames per second.
inline host::SimulationOptions Scene(host::ObjectKind object, int frames) {
  host::SimulationOptions options;
  options.object = object;
  options.motion = host::MotionKind::kModerate;
  options.noise = host::NoiseKind::kWhite;
  options.frames = frames;
  return options;
}

}  // namespace disflow::testing
