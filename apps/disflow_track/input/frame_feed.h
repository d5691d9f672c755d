// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <thread>

#include "disflow/hal/depth_sensor.h"
#include "disflow/posix/monotonic_clock.h"
#include "input/frame_handover.h"
#include "input/frame_source.h"
#include "program/realtime_options.h"

namespace disflow::apps {

/// The frames of a source as the tracking thread gets them: straight from the source, every one, or
/// through a capture thread, the newest one.
class FrameFeed {
 public:
  /// One turn of the tracking loop.
  struct Turn {
    FrameSource::Event event = FrameSource::Event::kIdle;
    hal::SensorCounters counters;  ///< Of the sensor; frames that the tracker left out are skipped.
    Status fault = Status::kOk;    ///< Of an unreadable frame.
    bool source_is_alive = true;   ///< The source has turned since the last turn.
  };

  /// @param threaded Take frames in a thread of its own; see FrameHandover.
  FrameFeed(hal::DepthSensor& sensor, FrameSource& source, bool threaded,
            const RealtimeOptions& realtime, Console& console);
  FrameFeed(const FrameFeed&) = delete;
  FrameFeed& operator=(const FrameFeed&) = delete;
  ~FrameFeed();

  /// @param inputs Descriptors that may show input; then, with a capture thread, the turn is
  /// kInput. kIdle comes no later for it.
  /// @throws Failure kInputFailed if the sensor failed for good.
  [[nodiscard]] Turn Next(DepthFrame& frame, std::span<const int> inputs = {});

 private:
  void Capture(const RealtimeOptions& realtime, Console& console);
  void CaptureAll();
  [[nodiscard]] Turn TakeNewest(DepthFrame& frame, std::span<const int> inputs);
  [[nodiscard]] FrameHandover::Taken AwaitNewest(DepthFrame& frame, Status& fault,
                                                 std::span<const int> inputs);

  hal::DepthSensor& sensor_;
  FrameSource& source_;
  std::unique_ptr<FrameHandover> handover_;  ///< Null: not threaded.
  std::atomic<bool> stop_ = false;
  std::atomic<std::uint32_t> capture_turns_ = 0;
  std::uint32_t seen_turns_ = 0;
  posix::MonotonicClock clock_;
  std::int64_t idle_at_ns_ = 0;   ///< When the wait for a frame ends; 0: none began.
  std::int64_t input_at_ns_ = 0;  ///< Of the last kInput.
  std::mutex counters_mutex_;
  hal::SensorCounters counters_;  ///< As of the capture thread's last turn.
  std::thread thread_;
};

}  // namespace disflow::apps
