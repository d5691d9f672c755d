// SPDX-License-Identifier: BSD-3-Clause
#include "run.h"

#include "console.h"
#include "disflow/distance_flow.h"
#include "disflow/posix/monotonic_clock.h"
#include "disflow/tracker.h"
#include "frame_feed.h"
#include "object_channel.h"
#include "outputs.h"
#include "run_report.h"
#include "sensor_choice.h"
#include "service_status.h"
#include "side_inputs.h"
#include "stop_signal.h"
#include "surface_mesh.h"

namespace disflow::apps {
namespace {

using posix::MonotonicClock;

std::int64_t ReadClock(void* context) { return static_cast<MonotonicClock*>(context)->NowNs(); }

template <class Limits>
void WriteMesh(const DistanceField<Limits>& field, const Options& options, Outputs& outputs) {
  static SurfaceWorkspace<Limits> workspace;  // too large for a stack
  SurfaceMesh mesh;
  // An empty model gives an empty mesh, which is said there.
  (void)ExtractSurface(
      field, DrawingOptions(options.config.field, static_cast<float>(options.mesh_resolution_m)),
      workspace, mesh);
  outputs.WriteMesh(mesh);
}

template <class Limits>
void WriteFlow(const Tracker<Limits>& tracker, const FrameResult& result, Outputs& outputs) {
  FlowCloud* const cloud = outputs.flow();
  if (cloud == nullptr) return;
  cloud->Clear();
  if (StreamFlow(tracker, result.estimate, *cloud) > 0) outputs.WriteFlow(result);
}

/// A run from its first frame to its last, with all that it reads and writes.
template <class Limits>
class TrackingRun {
 public:
  /// @throws Failure for what keeps the run from starting.
  TrackingRun(const Options& options, Tracker<Limits>& tracker)
      : options_(options),
        tracker_(tracker),
        console_(!options.headless),
        opener_(options.sensor, sensor_),
        info_(sensor_.get()->info()),
        inputs_(options, info_),
        outputs_(options, console_, inputs_.camera_poses()),
        source_(*sensor_.get(), clock_, options.rate, options.frames, console_),
        channel_("object", options.object_index, ObjectChannel::NewSnapshot<Limits>) {}

  [[nodiscard]] ExitStatus Run() {
    const std::int64_t begin_ns = clock_.NowNs();
    ExitStatus status = kDone;
    try {
      Track();
    } catch (const Failure& failure) {
      // What was tracked so far is kept and written.
      console_.Say(failure.what());
      status = failure.status();
    }
    const double seconds = static_cast<double>(clock_.NowNs() - begin_ns) * 1e-9;
    service_.Stopping();
    if (status == kDone) status = JudgeInput();
    if (outputs_.wants_mesh()) WriteMesh(tracker_.field(), options_, outputs_);
    const bool complete = outputs_.Finish();
    console_.Say(report_.Format(seconds));
    for (const std::string& line : inputs_.Summary()) console_.Say(line);
    for (const std::string& line : outputs_.written()) console_.Say(line);
    return status == kDone && !complete ? kOutputFailed : status;
  }

 private:
  /// So that opening has its place among the members.
  struct Opener {
    Opener(const std::string& uri, host::Sensor& sensor) { OpenSensor(uri, sensor); }
  };

  void Track() {
    const bool live = info_.live || options_.rate == Rate::kLive;
    if (live) console_.WriteInBackground();
    FrameFeed feed(*sensor_.get(), source_, live, options_.realtime, console_);
    // The capture thread is there already, or it would inherit what is asked for here.
    ApplyToTrackingThread(options_.realtime, console_);
    LockProcessMemory(options_.realtime, console_);
    service_.Ready();
    for (;;) {
      if (channel_.paused() && !StopRequested()) {
        Rest();
        continue;
      }
      const FrameFeed::Turn turn = feed.Next(frame_);
      if (turn.event == FrameSource::Event::kEnd) return;
      if (turn.event == FrameSource::Event::kIdle) {
        outputs_.KeepAlive(clock_.NowNs());
      } else {
        Take(turn);
      }
      service_.Turn(result_, turn.source_is_alive, clock_.NowNs());
    }
  }

  /// While somebody has paused the run: all stay informed that it lives.
  void Rest() {
    constexpr std::int64_t kRest_ns = 20'000'000;
    const std::int64_t now_ns = clock_.NowNs();
    clock_.SleepUntilNs(now_ns + kRest_ns);
    outputs_.KeepAlive(now_ns);
    service_.Turn(result_, /*source_is_alive=*/true, now_ns);
  }

  void Take(const FrameFeed::Turn& turn) {
    const bool readable = turn.event == FrameSource::Event::kFrame;
    result_.sensor = turn.counters;
    if (readable) {
      TrackFrame(turn.counters);
    } else {
      // The last pose stands; the row says that it is not of this frame.
      result_.estimate.status = turn.fault;
      result_.estimate.stage_ns.fill(0);
      result_.total_ns = 0;
    }
    const std::int64_t now_ns = clock_.NowNs();
    outputs_.Deliver(result_, readable ? &frame_ : nullptr, source_.AgeNs(frame_.stamp_ns), now_ns);
    channel_.Offer(tracker_, result_, readable ? &frame_ : nullptr);
    report_.Add(result_);
    console_.Show(result_, now_ns);
    ++result_.frame;
  }

  void TrackFrame(const hal::SensorCounters& counters) {
    const StageClock stage_clock = options_.timing ? StageClock{ReadClock, &clock_} : StageClock{};
    const std::int64_t begin_ns = clock_.NowNs();
    outputs_.Receive(begin_ns);
    if (channel_.TakeReset()) tracker_.Reset();
    inputs_.Attach(frame_, console_);
    (void)tracker_.Process(frame_, result_.estimate, stage_clock);  // the estimate carries it
    result_.total_ns = clock_.NowNs() - begin_ns;
    result_.totals = tracker_.totals();
    // A camera that was away may have been moved: listeners are told as of a new start.
    result_.estimate.reset_counter =
        static_cast<std::uint8_t>(result_.estimate.reset_counter + counters.reconnects);
    WriteFlow(tracker_, result_, outputs_);
  }

  /// Judges the input of a run that came to its end.
  [[nodiscard]] ExitStatus JudgeInput() {
    if (report_.frames() == 0) {
      if (StopRequested()) return kDone;
      console_.Say("the sensor delivered no frame");
      return kInputFailed;
    }
    if (report_.registered() == 0) {
      console_.Say("no frame could be tracked: " +
                   std::string(Describe(report_.most_frequent_fault())));
      return kInputFailed;
    }
    if (source_.unreadable() > 0 && !info_.live) {
      console_.Say(std::to_string(source_.unreadable()) + " frames could not be read");
      return kInputFailed;
    }
    return kDone;
  }

  const Options& options_;
  Tracker<Limits>& tracker_;
  Console console_;
  MonotonicClock clock_;
  host::Sensor sensor_;
  Opener opener_;
  hal::SensorInfo info_;
  SideInputs inputs_;
  Outputs outputs_;
  FrameSource source_;
  ServiceStatus service_;
  ObjectChannel channel_;
  DepthFrame frame_;
  FrameResult result_;
  RunReport report_;
};

template <class Limits>
ExitStatus RunWith(const Options& options) {
  static Tracker<Limits> tracker(options.config);  // MiBs: not on the stack
  return TrackingRun<Limits>(options, tracker).Run();
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
