// SPDX-License-Identifier: BSD-3-Clause
#include "objects/tracked_object.h"

#include <utility>

#include "disflow/tracker.h"

namespace disflow::apps {
namespace {

template <class Limits>
class TrackedObjectOf final : public TrackedObject {
 public:
  explicit TrackedObjectOf(const ObjectOptions& options)
      : TrackedObject(options, ObjectChannel::NewSnapshot<Limits>), tracker_(options.config) {}

 private:
  void DoReset() noexcept override { tracker_.Reset(); }
  // The channel has refused what the tracker would.
  void DoAdjust(const Config& config) noexcept override { (void)tracker_.Adjust(config); }
  Status DoChoose(const ObjectStart& start) noexcept override { return tracker_.Choose(start); }

  void DoTrack(const DepthFrame& frame, StageClock clock, FrameResult& result) noexcept override {
    (void)tracker_.Process(frame, result.estimate, clock);  // the estimate carries it
    result.totals = tracker_.totals();
    result.model_coarseness = tracker_.field().coarseness();
  }

  void DoShow(const FrameResult& result, const DepthFrame* frame) override {
    channel().Offer(tracker_, result, frame);
  }

  int DoStreamFlow(const Estimate& estimate, FlowSink& sink) const noexcept override {
    return disflow::StreamFlow(tracker_, estimate, sink);
  }

  int DoStreamSamples(SampleSink& sink) const noexcept override {
    return disflow::StreamSamples(tracker_.field(), sink);
  }

  Expected<DistanceQuery> DoQuery(const Vec3& x_m) noexcept override {
    return reader_.Query(tracker_.field(), tracker_.config().field, x_m);
  }

  void DoExtract(float resolution_m, SurfaceMesh& mesh) override {
    // An empty model gives an empty mesh, which is said where it is written.
    (void)reader_.Extract(tracker_.field(), tracker_.config().field, resolution_m, mesh);
  }

  Tracker<Limits> tracker_;
  ModelReader<Limits> reader_;
};

/// What make() returns for the capacities of a profile.
template <class Made, class Make>
Made WithLimits(ProfileName profile, Make&& make) {
  switch (profile) {
    case ProfileName::kMicro:
      return make(profiles::Micro{});
    case ProfileName::kEdge:
      return make(profiles::Edge{});
    case ProfileName::kDense:
      return make(profiles::Dense{});
  }
  return {};
}

}  // namespace

void TrackedObject::Track(const DepthFrame& frame, StageClock clock, FrameResult& result) noexcept {
  if (Config config; channel_.settings().Take(config)) DoAdjust(config);
  if (channel_.TakeReset()) DoReset();
  if (channel_.TakeChoice(offered_)) Begin(frame);
  DepthFrame own = frame;
  own.mask = MaskIn(frame);
  DoTrack(own, clock, result);
  if (result.estimate.status == Status::kOk) awaits_masked_ = false;
}

void TrackedObject::Begin(const DepthFrame& frame) noexcept {
  const std::optional<ObjectStart> start = StartIn(frame, offered_);
  if (!start || DoChoose(*start) != Status::kOk) return;
  std::swap(choice_, offered_);
  awaits_masked_ = choice_.kind == ObjectChoice::Kind::kMask;
  masks_ = awaits_masked_ ? ChosenMasks{} : MasksOf(frame, *start, masks_);
}

MaskView TrackedObject::MaskIn(const DepthFrame& frame) const noexcept {
  if (awaits_masked_) {
    return {choice_.mask.data(), choice_.mask_width_px, choice_.mask_height_px,
            choice_.mask_width_px};
  }
  MaskView mask = masks_.used ? frame.mask : MaskView{};
  mask.label = masks_.label;
  return mask;
}

std::size_t MaxModelSamples(ProfileName profile) noexcept {
  return WithLimits<std::size_t>(profile, [](auto limits) {
    return static_cast<std::size_t>(limits.kMaxClusters) *
           static_cast<std::size_t>(limits.kMaxSamplesPerCluster);
  });
}

std::unique_ptr<TrackedObject> MakeTrackedObject(ProfileName profile,
                                                 const ObjectOptions& options) {
  using Made = std::unique_ptr<TrackedObject>;
  return WithLimits<Made>(profile, [&options](auto limits) -> Made {
    return std::make_unique<TrackedObjectOf<decltype(limits)>>(options);
  });
}

}  // namespace disflow::apps
