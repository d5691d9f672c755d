// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "disflow/tracker.h"
#include "flow_cloud.h"
#include "objects/depth_picture.h"
#include "objects/model_reader.h"
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
    return reader_.Query(field_, config_.field, x_m);
  }
  int StreamSamples(SampleSink& sink) const noexcept override {
    return disflow::StreamSamples(field_, sink);
  }
  [[nodiscard]] Expected<SurfaceCounts> ExtractSurface(float resolution_m,
                                                       TriangleSink& sink) noexcept override {
    return reader_.Extract(field_, config_.field, resolution_m, sink);
  }

 private:
  Config config_;
  typename Tracker<Limits>::Field field_;
  ModelReader<Limits> reader_;
};

}  // namespace disflow::apps
