// SPDX-License-Identifier: BSD-3-Clause
#include "run.h"

#include <algorithm>

#include "console.h"
#include "disflow/distance_flow.h"
#include "disflow/posix/monotonic_clock.h"
#include "disflow/tracker.h"
#include "frame_source.h"
#include "outputs.h"
#include "run_report.h"
#include "sensor_choice.h"
#include "stop_signal.h"
#include "surface_mesh.h"

namespace disflow::apps {
namespace {

using posix::MonotonicClock;

std::int64_t ReadClock(void* context) { return static_cast<MonotonicClock*>(context)->NowNs(); }

SurfaceOptions MeshOptions(const Options& options) {
  const FieldConfig& field = options.config.field;
  SurfaceOptions surface;
  // Finer than the model's own detail is waste, coarser loses it.
  surface.resolution_m = options.mesh_resolution_m > 0.0
                             ? static_cast<float>(options.mesh_resolution_m)
                             : field.cell_size_m / 10.0F;
  surface.support_radius_m = 1.6F * field.merge_radius_m;
  return surface;
}

template <class Limits>
void WriteMesh(const DistanceField<Limits>& field, const Options& options, Outputs& outputs) {
  static SurfaceWorkspace<Limits> workspace;  // too large for a stack
  SurfaceMesh mesh;
  // An empty model gives an empty mesh, which is said there.
  (void)ExtractSurface(field, MeshOptions(options), workspace, mesh);
  outputs.WriteMesh(mesh);
}

template <class Limits>
void WriteFlow(const Tracker<Limits>& tracker, const FrameResult& result, Outputs& outputs) {
  FlowCloud* const cloud = outputs.flow();
  if (cloud == nullptr) return;
  cloud->Clear();
  if (StreamFlow(tracker, result.estimate, *cloud) > 0) outputs.WriteFlow(result);
}

template <class Limits>
void Track(const Options& options, Tracker<Limits>& tracker, hal::DepthSensor& sensor,
           MonotonicClock& clock, FrameSource& source, Console& console, Outputs& outputs,
           RunReport& report) {
  const StageClock stage_clock = options.timing ? StageClock{ReadClock, &clock} : StageClock{};
  DepthFrame frame;
  FrameResult result;
  for (;;) {
    const FrameSource::Event event = source.Next(frame);
    if (event == FrameSource::Event::kEnd) return;
    if (event == FrameSource::Event::kIdle) {
      outputs.KeepAlive(clock.NowNs());
      continue;
    }
    const bool readable = event == FrameSource::Event::kFrame;
    if (readable) {
      const std::int64_t begin_ns = clock.NowNs();
      (void)tracker.Process(frame, result.estimate, stage_clock);  // the estimate carries it
      result.total_ns = clock.NowNs() - begin_ns;
      result.totals = tracker.totals();
      // A camera that was away may have been moved: listeners are told as of a new start.
      result.estimate.reset_counter =
          static_cast<std::uint8_t>(result.estimate.reset_counter + sensor.counters().reconnects);
      WriteFlow(tracker, result, outputs);
    } else {
      // The last pose stands; the row says that it is not of this frame.
      result.estimate.status = source.fault_status();
      result.estimate.stage_ns.fill(0);
      result.total_ns = 0;
    }
    result.sensor = sensor.counters();
    const std::int64_t now_ns = clock.NowNs();
    outputs.Deliver(result, readable ? &frame : nullptr, source.AgeNs(frame.stamp_ns), now_ns);
    report.Add(result);
    console.Show(result, now_ns);
    ++result.frame;
  }
}

/// Judges the input of a run that came to its end.
ExitStatus JudgeInput(const FrameSource& source, const RunReport& report, bool live,
                      Console& console) {
  if (report.frames() == 0) {
    if (StopRequested()) return kDone;
    console.Say("the sensor delivered no frame");
    return kInputFailed;
  }
  if (report.registered() == 0) {
    console.Say("no frame could be tracked: " +
                std::string(Describe(report.most_frequent_fault())));
    return kInputFailed;
  }
  if (source.unreadable() > 0 && !live) {
    console.Say(std::to_string(source.unreadable()) + " frames could not be read");
    return kInputFailed;
  }
  return kDone;
}

template <class Limits>
ExitStatus RunWith(const Options& options) {
  static Tracker<Limits> tracker(options.config);  // MiBs: not on the stack
  Console console(!options.headless);
  MonotonicClock clock;
  host::Sensor sensor;
  OpenSensor(options.sensor, sensor);
  Outputs outputs(options, console);
  FrameSource source(*sensor.get(), clock, options.rate, options.frames, console);
  RunReport report;

  const std::int64_t begin_ns = clock.NowNs();
  ExitStatus status = kDone;
  try {
    Track(options, tracker, *sensor.get(), clock, source, console, outputs, report);
  } catch (const Failure& failure) {
    // What was tracked so far is kept and written.
    console.Say(failure.what());
    status = failure.status();
  }
  const double seconds = static_cast<double>(clock.NowNs() - begin_ns) * 1e-9;
  if (status == kDone) status = JudgeInput(source, report, sensor.get()->info().live, console);
  if (outputs.wants_mesh()) WriteMesh(tracker.field(), options, outputs);
  const bool complete = outputs.Finish();
  console.Say(report.Format(seconds));
  for (const std::string& line : outputs.written()) console.Say(line);
  return status == kDone && !complete ? kOutputFailed : status;
}

}  // namespace

ExitStatus Run(const Options& options) {
  switch (options.profile) {
    case ProfileName::kMicro:
      return RunWith<profiles::Micro>(options);
    case ProfileName::kEdge:
      return RunWith<profiles::Edge>(options);
    case ProfileName::kDense:
      return RunWith<profiles::Dense>(options);
  }
  return kWrongUsage;
}

}  // namespace disflow::apps
