// SPDX-License-Identifier: BSD-3-Clause
// A profile of one's own: tracking, the surface and distances to it.
#include <cmath>
#include <cstdio>
#include <vector>

#include "disflow/field/distance_query.h"
#include "disflow/surface_extractor.h"
#include "disflow/tracker.h"
#include "moving_corner.h"
#include "own_profile.h"

namespace {

using consumer::OwnProfile;

class LargestStd : public disflow::TriangleSink {
 public:
  float std_m = 0.0F;

 private:
  void DoOnTriangle(const disflow::SurfaceVertex& a, const disflow::SurfaceVertex& b,
                    const disflow::SurfaceVertex& c) noexcept override {
    std_m = std::fmax(std_m, std::fmax(a.std_m, std::fmax(b.std_m, c.std_m)));
  }
};

}  // namespace

int main() {
  static disflow::Tracker<OwnProfile> tracker;
  std::vector<std::uint16_t> depth_mm(consumer::kWidth * consumer::kHeight);
  disflow::DepthFrame frame;
  frame.depth = {depth_mm.data(),
                 consumer::kWidth,
                 consumer::kHeight,
                 consumer::kWidth * 2,
                 disflow::DepthFormat::kUint16,
                 0.001F};
  frame.camera = consumer::kCamera;
  disflow::Estimate estimate;
  for (int i = 0; i < 10; ++i) {
    consumer::TakeImage(i / 30.0, frame.camera, depth_mm);
    frame.stamp_ns = 1 + i * 33'333'333LL;
    if (tracker.Process(frame, estimate) != disflow::Status::kOk) {
      std::fprintf(stderr, "frame %d: %s\n", i, disflow::Describe(estimate.status));
      return 1;
    }
  }

  static disflow::SurfaceWorkspace<OwnProfile> surface_workspace;
  LargestStd sink;
  const auto surface =
      disflow::ExtractSurface(tracker.field(), disflow::SurfaceOptions{}, surface_workspace, sink);
  if (!surface.ok()) return 1;
  std::printf("%d triangles, off by %.4f m at most\n", surface.value.triangles,
              static_cast<double>(sink.std_m));

  static disflow::DistanceQuerier<OwnProfile>::Workspace query_workspace;
  disflow::DistanceQuerier<OwnProfile> querier(tracker.field(), query_workspace, 0.01F);
  const auto finger = querier.Query({0.0F, 0.0F, -0.3F});
  if (!finger.ok()) return 1;
  std::printf("a finger there is %.3f m away\n", static_cast<double>(finger.value.distance_m));
  return surface.value.triangles > 100 && finger.value.distance_m > 0.1F &&
                 finger.value.distance_m < 0.3F
             ? 0
             : 1;
}
