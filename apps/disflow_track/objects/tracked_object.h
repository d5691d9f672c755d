// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "disflow/distance_flow.h"
#include "objects/object_channel.h"
#include "program/frame_result.h"
#include "settings/object_options.h"
#include "settings/options.h"
#include "surface_mesh.h"

namespace disflow::apps {

/// A tracker of any profile with what it is to track. Not thread-safe, but different objects may be
/// worked on by different threads.
class TrackedObject {
 public:
  /// @param new_snapshot See ObjectChannel.
  TrackedObject(const ObjectOptions& options,
                std::function<std::unique_ptr<ModelSnapshot>()> new_snapshot)
      : options_(options),
        masks_{options.uses_mask, options.label},
        channel_(options.name, options.index, std::move(new_snapshot), options.config) {}
  TrackedObject(const TrackedObject&) = delete;
  TrackedObject& operator=(const TrackedObject&) = delete;
  virtual ~TrackedObject() = default;

  /// Fills estimate and totals of the result. Takes settings that were changed first. Forgets the
  /// object first if the channel was asked to, or for the one that was chosen. A choice that lies
  /// in no image is left aside.
  void Track(const DepthFrame& frame, StageClock clock, FrameResult& result) noexcept;
  /// Shows the frame tracked last to the channel's listeners.
  /// @param frame Null if it could not be read.
  void ShowToListeners(const FrameResult& result, const DepthFrame* frame) {
    DoShow(result, frame);
  }
  /// The flow of the frame tracked last. @return How many samples.
  int StreamFlow(const Estimate& estimate, FlowSink& sink) const noexcept {
    return DoStreamFlow(estimate, sink);
  }
  /// The model's samples; see disflow::StreamSamples().
  int StreamSamples(SampleSink& sink) const noexcept { return DoStreamSamples(sink); }
  /// The model at a point of the object frame; see DistanceQuerier.
  [[nodiscard]] Expected<DistanceQuery> Query(const Vec3& x_m) noexcept { return DoQuery(x_m); }
  /// @param resolution_m 0: as fine as the model's own detail. Nothing known gives an empty mesh.
  void ExtractMesh(double resolution_m, SurfaceMesh& mesh) {
    DoExtract(static_cast<float>(resolution_m), mesh);
  }

  [[nodiscard]] const ObjectOptions& options() const noexcept { return options_; }
  [[nodiscard]] ObjectChannel& channel() noexcept { return channel_; }

 private:
  /// Begins what was chosen with this frame.
  void Begin(const DepthFrame& frame) noexcept;
  /// What shows the object in this frame.
  [[nodiscard]] MaskView MaskIn(const DepthFrame& frame) const noexcept;

  virtual void DoReset() noexcept = 0;
  virtual void DoAdjust(const Config& config) noexcept = 0;
  [[nodiscard]] virtual Status DoChoose(const ObjectStart& start) noexcept = 0;
  virtual void DoTrack(const DepthFrame& frame, StageClock clock, FrameResult& result) noexcept = 0;
  virtual void DoShow(const FrameResult& result, const DepthFrame* frame) = 0;
  virtual int DoStreamFlow(const Estimate& estimate, FlowSink& sink) const noexcept = 0;
  virtual int DoStreamSamples(SampleSink& sink) const noexcept = 0;
  virtual Expected<DistanceQuery> DoQuery(const Vec3& x_m) noexcept = 0;
  virtual void DoExtract(float resolution_m, SurfaceMesh& mesh) = 0;

  const ObjectOptions& options_;
  ChosenMasks masks_;
  ObjectChoice offered_;        ///< May lie in no image.
  ObjectChoice choice_;         ///< The last one that did.
  bool awaits_masked_ = false;  ///< What its mask shows was not seen yet.
  ObjectChannel channel_;
};

/// All objects of a run, in the order of Options::objects.
using TrackedObjects = std::vector<std::unique_ptr<TrackedObject>>;

/// As many samples as a model of this profile can have.
[[nodiscard]] std::size_t MaxModelSamples(ProfileName profile) noexcept;

/// Allocates the tracker's memory, all that it will ever use.
/// @param options Must outlive the object.
[[nodiscard]] std::unique_ptr<TrackedObject> MakeTrackedObject(ProfileName profile,
                                                               const ObjectOptions& options);

}  // namespace disflow::apps
