// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Time of whole frames in the Edge profile on the simulated camera at 640x360: median, 99th
/// percentile, maximum.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <memory>
#include <vector>

#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"
#include "disflow/tracker.h"

namespace disflow {
namespace {

constexpr int kFrames = 300;

struct StoredFrame {
  DepthFrame frame;
  std::vector<float> depth_m;
  std::vector<std::uint8_t> mask;
};

/// Rendered beforehand, so that only the tracker is timed.
std::vector<StoredFrame> RenderAll(host::ObjectKind object, host::MaskKind mask) {
  host::SimulationOptions options;
  options.object = object;
  options.motion = host::MotionKind::kFast;
  options.noise = host::NoiseKind::kWhite;
  options.mask = mask;
  options.frames = kFrames;
  host::Simulation simulation(options, host::MakeObjectMesh(object));
  std::vector<StoredFrame> frames(kFrames);
  for (int i = 0; i < kFrames; ++i) {
    StoredFrame& stored = frames[static_cast<std::size_t>(i)];
    simulation.Render(i, stored.frame);
    const DepthView& depth = stored.frame.depth;
    const auto pixels = static_cast<std::size_t>(depth.width_px * depth.height_px);
    stored.depth_m.resize(pixels);
    std::memcpy(stored.depth_m.data(), depth.data, pixels * sizeof(float));
    stored.frame.depth.data = stored.depth_m.data();
    if (stored.frame.mask.given()) {
      stored.mask.assign(stored.frame.mask.data, stored.frame.mask.data + pixels);
      stored.frame.mask.data = stored.mask.data();
    }
  }
  return frames;
}

void TrackSequence(benchmark::State& state, host::ObjectKind object, host::MaskKind mask) {
  using Clock = std::chrono::steady_clock;
  const auto frames = RenderAll(object, mask);
  std::vector<double> times_ms;
  for (auto _ : state) {
    const auto tracker = std::make_unique<Tracker<profiles::Edge>>();
    double total_s = 0.0;
    for (const StoredFrame& stored : frames) {
      Estimate estimate;
      const auto start = Clock::now();
      benchmark::DoNotOptimize(tracker->Process(stored.frame, estimate));
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      total_s += seconds;
      times_ms.push_back(1e3 * seconds);
    }
    state.SetIterationTime(total_s);
  }
  std::sort(times_ms.begin(), times_ms.end());
  const auto at = [&times_ms](double share) {
    return times_ms[static_cast<std::size_t>(share * static_cast<double>(times_ms.size() - 1))];
  };
  state.counters["frame_p50_ms"] = at(0.5);
  state.counters["frame_p99_ms"] = at(0.99);
  state.counters["frame_max_ms"] = at(1.0);
  state.counters["tracker_bytes"] = static_cast<double>(sizeof(Tracker<profiles::Edge>));
}

void BoxWithMask(benchmark::State& state) {
  TrackSequence(state, host::ObjectKind::kBox, host::MaskKind::kGt);
}
void BottleWithMask(benchmark::State& state) {
  TrackSequence(state, host::ObjectKind::kBottle, host::MaskKind::kGt);
}
void BoxWithoutMask(benchmark::State& state) {
  TrackSequence(state, host::ObjectKind::kBox, host::MaskKind::kNone);
}

BENCHMARK(BoxWithMask)->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK(BottleWithMask)->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK(BoxWithoutMask)->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace disflow
