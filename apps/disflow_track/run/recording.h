// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/depth_sensor.h"
#include "objects/sample_list.h"
#include "program/frame_result.h"
#include "settings/options.h"

namespace disflow::apps {

/// What is recorded of one frame.
struct RecordedFrame {
  const DepthFrame* frame = nullptr;     ///< Null if it could not be read.
  std::span<const FrameResult> results;  ///< In the order of Options::objects.
  std::span<const SampleList> models;    ///< Likewise; empty: not of this frame.
};

/// Where frames are recorded.
class Recording {
 public:
  Recording() = default;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  virtual ~Recording() = default;

  /// Hands a frame to the kernel, all or nothing. After a failure nothing more is added.
  [[nodiscard]] virtual hal::Fault Add(const RecordedFrame& frame) = 0;
  [[nodiscard]] virtual hal::Fault Finish() = 0;
  [[nodiscard]] virtual int frame_count() const noexcept = 0;
  [[nodiscard]] virtual std::int64_t size_bytes() const noexcept = 0;
  /// Whether it has a place for results and models, also for those of unreadable frames.
  [[nodiscard]] virtual bool has_results() const noexcept = 0;
};

/// Opens what --record names: a folder, or a file of messages. @throws Failure kWrongUsage,
/// kOutputFailed.
[[nodiscard]] std::unique_ptr<Recording> OpenRecording(const Options& options,
                                                       const hal::SensorInfo& sensor);

/// Which frames are recorded with their models: one in a while, by the time of the frames, so that
/// the same run is the same recording.
class ModelPace {
 public:
  [[nodiscard]] bool IsDue(StampNs stamp_ns) const noexcept;
  void Recorded(StampNs stamp_ns) noexcept { last_ns_ = stamp_ns; }

 private:
  std::optional<StampNs> last_ns_;
};

/// A recording that one thread writes while another looks how far it is.
class RecordingWriter {
 public:
  explicit RecordingWriter(std::unique_ptr<Recording> recording);

  /// By one thread at a time, as Finish(). After a failure it does nothing.
  void Write(const RecordedFrame& frame);
  [[nodiscard]] hal::Fault Finish() { return recording_->Finish(); }

  /// Whether it has ended for good; failure() then says why and after how many frames.
  [[nodiscard]] bool has_failed() const noexcept { return failed_; }
  /// @pre has_failed()
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }
  /// As of the last frame that was written.
  [[nodiscard]] int frame_count() const noexcept { return frames_; }
  [[nodiscard]] std::int64_t size_bytes() const noexcept { return bytes_; }
  [[nodiscard]] bool has_results() const noexcept { return has_results_; }

 private:
  const bool has_results_;
  std::unique_ptr<Recording> recording_;  ///< Null after a failure.
  std::string failure_;                   ///< Written before failed_ is set.
  std::atomic<bool> failed_ = false;
  std::atomic<int> frames_ = 0;
  std::atomic<std::int64_t> bytes_ = 0;
};

}  // namespace disflow::apps
