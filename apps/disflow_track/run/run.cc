// SPDX-License-Identifier: BSD-3-Clause
#include "run/run.h"

#include <algorithm>
#include <thread>

#include "dds/dds_output.h"
#include "disflow/posix/monotonic_clock.h"
#include "files/numbered_names.h"
#include "files/output_names.h"
#include "input/frame_feed.h"
#include "input/sensor_choice.h"
#include "input/side_inputs.h"
#include "objects/tracked_object.h"
#include "objects/worker_pool.h"
#include "program/console.h"
#include "program/stop_signal.h"
#include "run/outputs.h"
#include "run/run_report.h"
#include "run/service_status.h"
#include "run/settings_watch.h"
#include "run/state_log.h"
#include "view/view_output.h"

namespace disflow::apps {
namespace {

using posix::MonotonicClock;

std::int64_t ReadClock(void* context) { return static_cast<MonotonicClock*>(context)->NowNs(); }

/// Threads beside the tracking thread.
int WorkersFor(const Options& options) {
  const int objects = static_cast<int>(options.objects.size());
  // 0 if it is not known.
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int threads = options.threads > 0 ? options.threads : processors;
  return std::min(threads, objects) - 1;
}

TrackedObjects MakeObjects(const Options& options) {
  TrackedObjects objects;
  for (const ObjectOptions& object : options.objects)
    objects.push_back(MakeTrackedObject(options.profile, object));
  return objects;
}

std::vector<ObjectChannel*> ChannelsOf(const TrackedObjects& objects) {
  std::vector<ObjectChannel*> channels;
  for (const auto& object : objects) channels.push_back(&object->channel());
  return channels;
}

std::vector<std::string> NamesOf(const Options& options) {
  std::vector<std::string> names;
  for (const ObjectOptions& object : options.objects) names.push_back(object.name);
  return names;
}

/// What is known when a frame could not be read: where the tracker stands, and nothing of the
/// frame, its capture time included.
Estimate OfUnreadableFrame(const Estimate& last, Status fault) {
  Estimate estimate;
  estimate.status = fault;
  estimate.state = last.state;
  estimate.stamp_ns = last.stamp_ns;
  estimate.reset_counter = last.reset_counter;
  return estimate;
}

/// A run from its first frame to its last, with all that it reads and writes.
class TrackingRun {
 public:
  /// @param named The options before their outputs got numbers.
  /// @throws Failure for what keeps the run from starting.
  TrackingRun(const Options& options, const Options& named, const CommandLine& command)
      : options_(options),
        console_(!options.headless, options.log),
        ros_(OpenSensor(options, sensor_, console_)),
        info_(sensor_.get()->info()),
        inputs_(options, info_),
        outputs_(options, named, info_, console_, inputs_.camera_poses()),
        source_(*sensor_.get(), clock_, options.rate, options.frames, console_),
        objects_(MakeObjects(options)),
        dds_(options.dds_link, ChannelsOf(objects_), info_, inputs_, ros_),
        view_(options.view, ChannelsOf(objects_), console_),
        settings_watch_(command, options, ChannelsOf(objects_), console_),
        state_log_(NamesOf(options)),
        results_(options.objects.size()),
        reports_(options.objects.size()) {}

  [[nodiscard]] ExitStatus Run() {
    if (!sensor_.note().empty()) console_.Say(sensor_.note());
    const std::int64_t begin_ns = clock_.NowNs();
    ExitStatus status = kDone;
    try {
      Track();
    } catch (const Failure& failure) {
      // What was tracked so far is kept and written.
      console_.Say(failure.what(), Severity::kError);
      status = failure.status();
    }
    const double seconds = static_cast<double>(clock_.NowNs() - begin_ns) * 1e-9;
    service_.Stopping();
    if (status == kDone) status = JudgeInput();
    dds_.Finish();
    outputs_.WriteMeshes(objects_, options_.mesh_resolution_m);
    const bool complete = outputs_.Finish();
    Report(seconds);
    view_.EndOfInput();
    return status == kDone && !complete ? kOutputFailed : status;
  }

 private:
  void Track() {
    const bool live = info_.live || options_.rate == Rate::kLive;
    if (live) console_.WriteInBackground();
    WorkerPool pool(WorkersFor(options_), [this](int worker) {
      ApplyToWorkerThread(options_.realtime, worker, console_);
    });
    FrameFeed feed(*sensor_.get(), source_, live, options_.realtime, console_);
    // The other threads are there already, or they would inherit what is asked for here.
    ApplyToTrackingThread(options_.realtime, console_);
    LockProcessMemory(options_.realtime, console_);
    service_.Ready();
    for (;;) {
      if (IsPaused() && !StopRequested()) {
        Rest();
        continue;
      }
      const FrameFeed::Turn turn = feed.Next(frame_, outputs_.fds());
      if (turn.event == FrameSource::Event::kEnd) return;
      if (turn.event == FrameSource::Event::kInput) {
        // At once, so that the time at which a message came is known.
        outputs_.Receive(CaptureNowNs(clock_.NowNs()));
        continue;
      }
      if (turn.event == FrameSource::Event::kIdle) {
        KeepAlive(clock_.NowNs());
      } else {
        Take(turn, pool);
      }
      service_.Turn(results_, turn.source_is_alive, clock_.NowNs());
    }
  }

  /// Objects share the frames, so whoever pauses one pauses all.
  [[nodiscard]] bool IsPaused() const noexcept {
    return std::any_of(objects_.begin(), objects_.end(),
                       [](const auto& object) { return object->channel().paused(); });
  }

  /// While somebody has paused the run: all stay informed that it lives.
  void Rest() {
    constexpr std::int64_t kRest_ns = 20'000'000;
    const std::int64_t now_ns = clock_.NowNs();
    clock_.SleepUntilNs(now_ns + kRest_ns);
    KeepAlive(now_ns);
    service_.Turn(results_, /*source_is_alive=*/true, now_ns);
  }

  /// No frame comes: whoever is at the far ends of the links must not notice.
  void KeepAlive(std::int64_t now_ns) noexcept {
    outputs_.Receive(CaptureNowNs(now_ns));
    outputs_.KeepAlive(now_ns);
  }

  /// Now, on the clock of the frames' stamps. That of a replay or another machine goes on from
  /// frame to frame.
  [[nodiscard]] std::int64_t CaptureNowNs(std::int64_t now_ns) const noexcept {
    return info_.has_monotonic_stamps() ? now_ns : frame_.stamp_ns;
  }

  void Take(const FrameFeed::Turn& turn, WorkerPool& pool) {
    const bool readable = turn.event == FrameSource::Event::kFrame;
    for (FrameResult& result : results_) {
      result.sensor = turn.counters;
      result.recording_dropped = outputs_.recording_dropped();
    }
    if (readable) {
      TrackFrame(turn.counters, pool);
    } else {
      for (FrameResult& result : results_) {
        result.estimate = OfUnreadableFrame(result.estimate, turn.fault);
        result.total_ns = 0;
      }
    }
    const std::int64_t now_ns = clock_.NowNs();
    const DepthFrame* const frame = readable ? &frame_ : nullptr;
    outputs_.Deliver(objects_, results_, frame, source_.AgeNs(frame_.stamp_ns), now_ns);
    for (std::size_t i = 0; i < results_.size(); ++i) {
      objects_[i]->ShowToListeners(results_[i], frame);
      reports_[i].Add(results_[i]);
    }
    console_.Show(results_, now_ns);
    state_log_.Turn(results_, now_ns, console_);
    for (FrameResult& result : results_) ++result.frame;
  }

  void TrackFrame(const hal::SensorCounters& counters, WorkerPool& pool) {
    const std::int64_t begin_ns = clock_.NowNs();
    outputs_.Receive(CaptureNowNs(begin_ns));
    inputs_.Attach(frame_, console_);
    const std::int64_t shared_ns = clock_.NowNs() - begin_ns;
    const auto track = [this, &counters, shared_ns](std::size_t i) noexcept {
      TrackObject(*objects_[i], counters, shared_ns, results_[i]);
    };
    pool.ForEach(objects_.size(), track);
    all_objects_.Add(clock_.NowNs() - begin_ns);
    outputs_.Answer(objects_, results_);
    outputs_.WriteFlow(objects_, results_);
  }

  /// In any thread of the pool.
  void TrackObject(TrackedObject& object, const hal::SensorCounters& counters,
                   std::int64_t shared_ns, FrameResult& result) noexcept {
    const std::int64_t begin_ns = clock_.NowNs();
    const StageClock stage_clock = options_.timing ? StageClock{ReadClock, &clock_} : StageClock{};
    object.Track(frame_, stage_clock, result);
    // A camera that was away may have been moved: listeners are told as of a new start.
    result.estimate.reset_counter =
        static_cast<std::uint8_t>(result.estimate.reset_counter + counters.reconnects);
    result.total_ns = shared_ns + clock_.NowNs() - begin_ns;
  }

  /// Judges the input of a run that came to its end.
  [[nodiscard]] ExitStatus JudgeInput() {
    if (reports_.front().frames() == 0) {
      if (StopRequested()) return kDone;
      console_.Say("the sensor delivered no frame", Severity::kError);
      return kInputFailed;
    }
    bool any_tracked = false;
    for (std::size_t i = 0; i < reports_.size(); ++i) {
      any_tracked = any_tracked || reports_[i].registered() > 0;
      if (reports_[i].registered() > 0) continue;
      console_.Say(Prefix(i) + "no frame could be tracked: " +
                       std::string(Describe(reports_[i].most_frequent_fault())),
                   Severity::kError);
    }
    if (!any_tracked) return kInputFailed;
    if (source_.unreadable() > 0 && !info_.live) {
      console_.Say(std::to_string(source_.unreadable()) + " frames could not be read",
                   Severity::kError);
      return kInputFailed;
    }
    return kDone;
  }

  void Report(double seconds) {
    for (std::size_t i = 0; i < reports_.size(); ++i)
      console_.Say(Prefix(i) + reports_[i].Format(seconds));
    if (reports_.size() > 1) {
      console_.Say("all " + std::to_string(reports_.size()) + " objects, by " +
                   std::to_string(WorkersFor(options_) + 1) +
                   " threads: " + FormatTimes(all_objects_));
    }
    for (const std::string& line : inputs_.Summary()) console_.Say(line);
    for (const std::string& line : outputs_.written()) console_.Say(line);
    for (const std::string& line : dds_.Summary()) console_.Say(line);
  }

  /// Ahead of what is said of one of several objects.
  [[nodiscard]] std::string Prefix(std::size_t object) const {
    return options_.objects.size() > 1 ? options_.objects[object].name + ": " : "";
  }

  const Options& options_;
  Console console_;
  MonotonicClock clock_;
  host::Sensor sensor_;
  std::shared_ptr<posix::RosNode> ros_;  ///< Of a sensor that is ROS's own; else null.
  hal::SensorInfo info_;
  SideInputs inputs_;
  Outputs outputs_;
  FrameSource source_;
  ServiceStatus service_;
  DepthFrame frame_;
  TrackedObjects objects_;
  DdsOutput dds_;
  ViewOutput view_;
  SettingsWatch settings_watch_;
  StateLog state_log_;
  std::vector<FrameResult> results_;
  std::vector<RunReport> reports_;
  DurationHistogram all_objects_;
};

}  // namespace

ExitStatus Run(const Options& options, const CommandLine& command) {
  const Options numbered = NumberOutputs(options);
  RefuseSharedOutputs(numbered);
  return TrackingRun(numbered, options, command).Run();
}

}  // namespace disflow::apps
