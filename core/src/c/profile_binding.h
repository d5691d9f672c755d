// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <new>

#include "binding.h"
#include "disflow/field/distance_query.h"
#include "disflow/tracker.h"

namespace disflow::c {

/// A tracker of one profile behind the interface of all.
template <CapacityProfile Limits>
class ProfileTracker final : public disflow_tracker {
 public:
  using Workspace = SurfaceWorkspace<Limits>;

  explicit ProfileTracker(const Config& config) noexcept : tracker_(config) {}

 private:
  void Process(const DepthFrame& frame, Estimate& estimate) noexcept override {
    (void)tracker_.Process(frame, estimate);
  }
  void Fuse(const DepthFrame& frame, const PoseObjectFromCamera& T_oc,
            Estimate& estimate) noexcept override {
    (void)tracker_.Fuse(frame, T_oc, estimate);
  }
  void Reset() noexcept override { tracker_.Reset(); }
  Status Choose(const ObjectStart& start) noexcept override { return tracker_.Choose(start); }

  void WriteMaskRow(int v, std::span<std::uint8_t> row) const noexcept override {
    for (int u = 0; std::uint8_t & pixel : row) pixel = tracker_.last_mask().Test(u++, v) ? 255 : 0;
  }

  Status ExtractSurface(const SurfaceOptions& options, void* workspace,
                        TriangleSink& sink) const noexcept override {
    // Default initialisation: what it holds is written before it is read.
    auto* const scratch = new (workspace) Workspace;
    return disflow::ExtractSurface(tracker_.field(), options, *scratch, sink).status;
  }

  int StreamSamples(SampleSink& sink) const noexcept override {
    return disflow::StreamSamples(tracker_.field(), sink);
  }

  Status Query(const float* points_m, int point_count, float support_radius_m, void* workspace,
               disflow_distance* distances) const noexcept override {
    auto* const scratch = new (workspace) typename DistanceQuerier<Limits>::Workspace;
    DistanceQuerier<Limits> querier(tracker_.field(), *scratch, support_radius_m);
    for (int i = 0; i < point_count; ++i) {
      const float* const x = points_m + std::ptrdiff_t{3} * i;
      const Expected<DistanceQuery> answer = querier.Query(Vec3(x[0], x[1], x[2]));
      const Vec3& gradient = answer.value.gradient;
      distances[i] = {static_cast<disflow_status>(answer.status),
                      answer.value.in_bounds ? 1 : 0,
                      answer.value.distance_m,
                      {gradient.x(), gradient.y(), gradient.z()},
                      answer.value.variance_m2};
    }
    return tracker_.field().empty() ? Status::kNotInitialised : Status::kOk;
  }

  [[nodiscard]] std::size_t workspace_bytes() const noexcept override { return sizeof(Workspace); }

  Tracker<Limits> tracker_;
};

/// @tparam kBytes What disflow.h promises to be enough.
template <CapacityProfile Limits, std::size_t kBytes>
constexpr disflow_profile MakeProfile() noexcept {
  using Bound = ProfileTracker<Limits>;
  using Workspace = typename Bound::Workspace;
  constexpr std::size_t kTrackerBytes = sizeof(Bound);
  constexpr std::size_t kWorkspaceBytes = sizeof(Workspace);
  static_assert(kTrackerBytes <= kBytes && kWorkspaceBytes <= DISFLOW_WORKSPACE_BYTES);
  static_assert(alignof(Bound) <= kAlignment && alignof(Workspace) <= kAlignment);
  return {Limits::kName,
          kTrackerBytes,
          kWorkspaceBytes,
          Limits::kMaxImageWidth,
          Limits::kMaxImageHeight,
          [](void* memory, const Config& config) noexcept -> disflow_tracker* {
            return new (memory) Bound(config);
          }};
}

}  // namespace disflow::c
