// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What each frame of a sequence costs, stage by stage, for ./dev bench cost: nanoseconds, or under
/// callgrind instructions: what lies between two marks is counted into a file of its own. A frame's
/// first mark is its beginning, then come those of the stages that it went through.

#include <valgrind/callgrind.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "disflow/host/open_sensor.h"
#include "disflow/tracker.h"

namespace disflow {
namespace {

struct StoredFrame {
  DepthFrame frame;
  std::vector<std::byte> depth;
  std::vector<std::uint8_t> mask;
};

/// Read beforehand, so that the tracker alone is measured.
std::deque<StoredFrame> ReadFrames(hal::DepthSensor& sensor, std::size_t most) {
  constexpr std::int64_t kPatience_ns = 10'000'000'000;
  std::deque<StoredFrame> frames;
  DepthFrame frame;
  while (frames.size() < most && sensor.Next(kPatience_ns, frame).ok()) {
    StoredFrame& stored = frames.emplace_back();
    stored.frame = frame;
    stored.depth.assign(frame.depth.row(0), frame.depth.row(frame.depth.height_px));
    stored.frame.depth.data = stored.depth.data();
    if (!frame.mask.given()) continue;
    stored.mask.assign(frame.mask.row(0), frame.mask.row(frame.mask.height_px));
    stored.frame.mask.data = stored.mask.data();
  }
  return frames;
}

std::int64_t Now_ns(void*) noexcept {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch())
      .count();
}

/// Callgrind notes what was counted since the last mark. Advances by one, so that the stages that a
/// frame went through have 1 in its line.
std::int64_t Mark(void* context) noexcept {
  CALLGRIND_DUMP_STATS;
  return ++*static_cast<std::int64_t*>(context);
}

struct Table {
  void PrintHeader() const {
    std::printf("frame,status");
    for (std::size_t i = 0; i < kStageCount; ++i) std::printf(",%s", Name(static_cast<Stage>(i)));
    std::printf("\n");
  }
  void Print(std::size_t frame, const Estimate& estimate) const {
    std::printf("%zu,%s", frame, Describe(estimate.status));
    for (const std::int64_t ns : estimate.stage_ns)
      std::printf(",%lld", static_cast<long long>(ns));
    std::printf("\n");
  }
};

template <class Profile>
void Run(const std::deque<StoredFrame>& frames, const Config& config, bool counted) {
  const auto tracker = std::make_unique<Tracker<Profile>>(config);
  std::int64_t marks = 0;
  const StageClock clock{counted ? &Mark : &Now_ns, &marks};
  const Table table;
  table.PrintHeader();
  if (counted) CALLGRIND_START_INSTRUMENTATION;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Estimate estimate;
    (void)tracker->Process(frames[i].frame, estimate, clock);  // the estimate carries it
    table.Print(i, estimate);
  }
}

using Runner = std::function<void(const std::deque<StoredFrame>&, const Config&, bool)>;
const std::map<std::string, Runner> kProfiles{{"micro", Run<profiles::Micro>},
                                              {"edge", Run<profiles::Edge>},
                                              {"dense", Run<profiles::Dense>}};

}  // namespace
}  // namespace disflow

int main(int argc, char** argv) {
  std::string address;
  std::string profile = "edge";
  std::size_t frames = 300;
  std::vector<int> seed_px;
  CLI::App app("Prints what each frame of a sequence costs the tracker, in ns by stage.",
               "frame_cost");
  app.add_option("--sensor", address, "Where depth images come from, as of disflow_track")
      ->required();
  app.add_option("--profile", profile)
      ->check(CLI::IsMember(disflow::kProfiles))
      ->capture_default_str();
  app.add_option("--frames", frames, "At most so many")->capture_default_str();
  app.add_option("--seed", seed_px, "A pixel on the object in the first frame")
      ->delimiter(',')
      ->expected(2)
      ->type_name("U,V");
  CLI11_PARSE(app, argc, argv);
  disflow::Config config;
  if (!seed_px.empty()) {
    config.segmenter.seed_u_px = seed_px[0];
    config.segmenter.seed_v_px = seed_px[1];
  }
  disflow::host::Sensor sensor;
  if (const auto fault = disflow::host::OpenSensor(address, sensor); !fault.ok()) {
    std::fprintf(stderr, "frame_cost: %s\n", fault.message);
    return 1;
  }
  disflow::kProfiles.at(profile)(disflow::ReadFrames(*sensor.get(), frames), config,
                                 RUNNING_ON_VALGRIND != 0);
  return 0;
}
