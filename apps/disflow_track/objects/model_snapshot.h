// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "disflow/field/distance_query.h"
#include "disflow/surface_extractor.h"
#include "disflow/tracker.h"
#include "flow_cloud.h"
#include "objects/depth_picture.h"
#include "program/frame_result.h"

namespace disflow::apps {

/// A copy of what a tracker knows after a frame, so that other threads can look at it as long as
/// they want.
class ModelSnapshot {
 public:
  ModelSnapshot() = default;
  ModelSnapshot(const ModelSnapshot&) = delete;
  ModelSnapshot& operator=(const ModelSnapshot&) = delete;
  virtual ~ModelSnapshot() = default;

  [[nodiscard]] const FrameResult& result() const noexcept { return result_; }
  /// Distance flow of the frame, camera frame.
  [[nodiscard]] const FlowCloud& flow() const noexcept { return flow_; }
  [[nodiscard]] const DepthPicture& picture() const noexcept { return picture_; }
  /// Of the tracker.
  [[nodiscard]] virtual const Config& config() const noexcept = 0;

  /// Distance, gradient and variance at a point of the object frame; see DistanceQuerier. Not for
  /// two threads at once.
  [[nodiscard]] virtual Expected<DistanceQuery> Query(const Vec3& x_m) noexcept = 0;
  /// See disflow::StreamSamples().
  virtual int StreamSamples(SampleSink& sink) const noexcept = 0;
  /// See disflow::ExtractSurface(). Not for two threads at once.
  /// @param resolution_m 0: as fine as the model's own detail.
  [[nodiscard]] virtual Expected<SurfaceCounts> ExtractSurface(float resolution_m,
                                                               TriangleSink& sink) noexcept = 0;

 protected:
  FrameResult result_;
  FlowCloud flow_;
  DepthPicture picture_;
};

/// How a model's surface is drawn.
/// @param resolution_m 0: finer than the model's own detail is waste, coarser loses it.
[[nodiscard]] inline SurfaceOptions DrawingOptions(const FieldConfig& field,
                                                   float resolution_m) noexcept {
  SurfaceOptions surface;
  surface.resolution_m = resolution_m > 0.0F ? resolution_m : field.cell_size_m / 10.0F;
  surface.support_radius_m = 1.6F * field.merge_radius_m;
  return surface;
}

template <class Limits>
class TrackerSnapshot final : public ModelSnapshot {
 public:
  TrackerSnapshot() { flow_.Reserve(Limits::kMaxSurfaceSamples); }

  /// By the tracking thread, after a frame. Copies about the tracker's size; does not allocate.
  /// @param frame Null if it could not be read: the picture is then that of the last one.
  void Take(const Tracker<Limits>& tracker, const FrameResult& result, const DepthFrame* frame) {
    result_ = result;
    config_ = tracker.config();
    field_ = tracker.field();
    flow_.Clear();
    if (frame == nullptr) return;
    (void)StreamFlow(tracker, result.estimate, flow_);
    picture_.Take(*frame, tracker.last_mask());
  }

  [[nodiscard]] const Config& config() const noexcept override { return config_; }

  [[nodiscard]] Expected<DistanceQuery> Query(const Vec3& x_m) noexcept override {
    const float support_radius_m = DrawingOptions(config_.field, 0.0F).support_radius_m;
    return DistanceQuerier<Limits>(field_, workspace_.gp, support_radius_m).Query(x_m);
  }
  int StreamSamples(SampleSink& sink) const noexcept override {
    return disflow::StreamSamples(field_, sink);
  }
  [[nodiscard]] Expected<SurfaceCounts> ExtractSurface(float resolution_m,
                                                       TriangleSink& sink) noexcept override {
    return disflow::ExtractSurface(field_, DrawingOptions(config_.field, resolution_m), workspace_,
                                   sink);
  }

 private:
  Config config_;
  typename Tracker<Limits>::Field field_;
  SurfaceWorkspace<Limits> workspace_;
};

}  // namespace disflow::apps
