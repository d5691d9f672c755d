// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "disflow/estimate.h"
#include "disflow/flow/sample_match.h"
#include "disflow/tracker.h"
#include "disflow/types.h"

/// @file
/// The distance flow of a frame: how far each observed point is from the model, in which direction
/// that distance grows, and how the point moves with the object.

namespace disflow {

/// One observed point of the frame processed last; all in the camera frame.
struct FlowSample {
  Vec3 position_m = Vec3::Zero();  ///< x
  Vec3 normal = Vec3::Zero();      ///< Observed, unit length, towards the camera.
  /// Residual distance d of the point to the model, which has learnt from this frame too; positive
  /// outside. NaN if the model has no surface there.
  float distance_m = std::numeric_limits<float>::quiet_NaN();
  Vec3 gradient = Vec3::Zero();  ///< Of d; zero if the model has no surface there.
  Vec3 flow_mps = Vec3::Zero();  ///< v + omega x (x - p), p the object's origin.
};

/// Receives the samples one by one.
class FlowSink {
 public:
  FlowSink(const FlowSink&) = delete;
  FlowSink& operator=(const FlowSink&) = delete;
  void OnSample(const FlowSample& sample) noexcept { DoOnSample(sample); }

 protected:
  FlowSink() = default;
  ~FlowSink() = default;

 private:
  virtual void DoOnSample(const FlowSample& sample) noexcept = 0;
};

/// Velocity of a point that is fixed to the object, camera axes.
/// @param x_m The point, camera frame.
[[nodiscard]] inline Vec3 VelocityAt(const Estimate& estimate, const Vec3& x_m) noexcept {
  const Vec3 arm_m = x_m - estimate.T_co.translation();
  return estimate.twist.linear_mps + estimate.twist.angular_rps.cross(arm_m);
}

/// Streams the surface samples of the frame that the tracker processed last, in a fixed order.
/// @param estimate What Process() said of that frame.
/// @return How many; 0 if the frame was refused, showed nothing of the object, or was a
///     repeated image (kRepeatedImage).
template <class Limits>
int StreamFlow(const Tracker<Limits>& tracker, const Estimate& estimate, FlowSink& sink) noexcept {
  if (estimate.samples == 0) return 0;
  const RegistrationConfig& config = tracker.config().registration;
  const PoseObjectFromCamera T_oc = estimate.T_co.Inverse();
  for (const SurfaceSample& observed : tracker.last_samples()) {
    FlowSample sample;
    sample.position_m = observed.position_m;
    sample.normal = observed.normal;
    sample.flow_mps = VelocityAt(estimate, observed.position_m);
    const auto match = MatchOf(tracker.field(), config, T_oc, observed);
    if (match.found) {
      sample.distance_m = match.distance_m;
      sample.gradient = estimate.T_co.rotation() * match.gradient;
    }
    sink.OnSample(sample);
  }
  return tracker.last_samples().size();
}

}  // namespace disflow
