// SPDX-License-Identifier: BSD-3-Clause
#include "peer_run.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include "allocation_count.h"
#include "disflow/host/open_sensor.h"
#include "disflow/posix/monotonic_clock.h"
#include "disflow/tracker.h"
#include "files/trajectory_csv.h"
#include "icp_tracker.h"
#include "program/exit_status.h"

namespace disflow::bench {
namespace {

using apps::Failure;
using apps::FrameResult;
using Process = std::function<void(const DepthFrame&, FrameResult&)>;

Process MakeMethod(const PeerOptions& options) {
  if (options.method == Method::kDisflow) {
    const auto tracker = std::make_shared<Tracker<profiles::Edge>>();
    return [tracker](const DepthFrame& frame, FrameResult& result) {
      (void)tracker->Process(frame, result.estimate);  // the estimate carries it
    };
  }
  const auto tracker = std::make_shared<IcpTracker>(options.icp);
  return [tracker](const DepthFrame& frame, FrameResult& result) {
    tracker->Process(frame, result.estimate);
  };
}

/// A value of /proc/self/status in bytes: VmRSS is what the process holds, VmHWM the most it held.
long MemoryBytes(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(name + ":"))
      return 1024L * std::strtol(line.c_str() + name.size() + 1, nullptr, 10);
  }
  throw Failure(apps::kInputFailed, "/proc/self/status: has no line " + name);
}

PeerCost Summarise(std::vector<double> times_ms, long allocations) {
  PeerCost cost;
  if (times_ms.empty()) throw Failure(apps::kInputFailed, "the sequence has no frame");
  const auto count = static_cast<double>(times_ms.size());
  cost.frames = static_cast<int>(times_ms.size());
  cost.mean_ms = std::accumulate(times_ms.begin(), times_ms.end(), 0.0) / count;
  const auto middle = times_ms.begin() + static_cast<std::ptrdiff_t>(times_ms.size() / 2);
  std::nth_element(times_ms.begin(), middle, times_ms.end());
  cost.median_ms = *middle;
  cost.allocations_per_frame = static_cast<double>(allocations) / count;
  return cost;
}

/// The velocity at the end of two equal intervals, from their means.
Twist Extrapolated(const Twist& before, const Twist& now) {
  return {1.5F * now.linear_mps - 0.5F * before.linear_mps,
          1.5F * now.angular_rps - 0.5F * before.angular_rps};
}

/// The trajectory, and if asked for the one of extrapolated velocities.
class Trajectories {
 public:
  explicit Trajectories(const PeerOptions& options) : plain_(options.csv, /*timing=*/true) {
    if (!options.csv_extrapolated.empty())
      extrapolated_.emplace(options.csv_extrapolated, /*timing=*/true);
  }

  void Write(FrameResult result) {
    WriteOne(result, plain_);
    const Twist now = result.estimate.twist;
    if (result.frame > 1) result.estimate.twist = Extrapolated(before_, now);
    before_ = now;
    if (extrapolated_) WriteOne(result, *extrapolated_);
  }

 private:
  static void WriteOne(const FrameResult& result, apps::TrajectoryCsv& csv) {
    if (!csv.Write(result))
      throw Failure(apps::kOutputFailed, csv.file().path() + ": cannot be written");
  }

  apps::TrajectoryCsv plain_;
  std::optional<apps::TrajectoryCsv> extrapolated_;
  Twist before_;
};

bool ReadNext(hal::DepthSensor& sensor, DepthFrame& frame) {
  const hal::Fault fault = sensor.Next(std::numeric_limits<std::int64_t>::max(), frame);
  if (fault.status == Status::kEndOfStream) return false;
  apps::Require(fault, apps::kInputFailed);
  return true;
}

}  // namespace

PeerCost RunPeer(const PeerOptions& options) {
  host::Sensor sensor;
  apps::Require(host::OpenSensor(options.sensor, sensor), apps::kInputFailed);
  Trajectories trajectories(options);
  posix::MonotonicClock clock;
  std::vector<double> times_ms;
  long allocations = 0;
  DepthFrame frame;
  FrameResult result;
  // The reader holds its images from the first frame on.
  bool more = ReadNext(*sensor.get(), frame);
  const long before_bytes = MemoryBytes("VmRSS");
  const Process process = MakeMethod(options);
  for (; more; more = ReadNext(*sensor.get(), frame)) {
    const long allocations_before = AllocationCount();
    const std::int64_t begin_ns = clock.NowNs();
    process(frame, result);
    result.total_ns = clock.NowNs() - begin_ns;
    allocations += AllocationCount() - allocations_before;
    times_ms.push_back(static_cast<double>(result.total_ns) * 1e-6);
    trajectories.Write(result);
    ++result.frame;
  }
  PeerCost cost = Summarise(std::move(times_ms), allocations);
  cost.memory_bytes = MemoryBytes("VmHWM") - before_bytes;
  return cost;
}

}  // namespace disflow::bench
