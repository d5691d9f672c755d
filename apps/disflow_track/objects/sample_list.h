// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "disflow/surface_extractor.h"

namespace disflow::apps {

/// From one message or recording of a model's samples to the next.
inline constexpr std::int64_t kModelPeriod_ns = 500'000'000;

/// The samples of a model at one moment, for those who look at them when the tracker has gone on.
class SampleList final : public SampleSink {
 public:
  /// See MaxModelSamples(): so many are taken without allocating.
  void Reserve(std::size_t samples) { samples_.reserve(samples); }
  /// @param model A TrackedObject or a ModelSnapshot.
  template <class Model>
  void Take(const Model& model) {
    samples_.clear();
    (void)model.StreamSamples(*this);
  }
  /// What was taken last, in the same order. @return How many.
  int StreamSamples(SampleSink& sink) const noexcept {
    for (const Sample& sample : samples_) sink.OnSample(sample.vertex, sample.observations);
    return static_cast<int>(samples_.size());
  }

 private:
  struct Sample {
    SurfaceVertex vertex;
    int observations = 0;
  };

  void DoOnSample(const SurfaceVertex& sample, int observations) noexcept override {
    samples_.push_back({sample, observations});
  }

  std::vector<Sample> samples_;
};

}  // namespace disflow::apps
