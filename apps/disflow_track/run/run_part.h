// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/trajectory_csv.h"
#include "program/frame_result.h"
#include "run/recording.h"
#include "run/recording_queue.h"
#include "settings/options.h"

namespace disflow::apps {

/// Trajectories and recording of a run, or of a part of it if they are rotated. One that fails is
/// left alone; the others go on.
class RunPart {
 public:
  /// Opens all that was asked for. @throws Failure kWrongUsage, kOutputFailed; files that existed
  /// are then unchanged.
  /// @param options After NumberOutputs().
  /// @param sensor Where the frames come from.
  /// @param queue Writes the recording and outlives this; null: who records a frame writes it.
  RunPart(const Options& options, const hal::SensorInfo& sensor, RecordingQueue* queue);
  RunPart(const RunPart&) = delete;
  RunPart& operator=(const RunPart&) = delete;
  ~RunPart();

  /// A row of an object's trajectory. @throws Failure kOutputFailed, once.
  void WriteRow(std::size_t object, const FrameResult& result);
  /// @param frame Null if it could not be read. @throws Failure kOutputFailed, once; of what the
  /// queue could not write with one of the next frames.
  void Record(const DepthFrame* frame, std::span<const FrameResult> results,
              const TrackedObjects& objects);

  /// Whether something of it could not be written.
  [[nodiscard]] bool has_failed() const noexcept { return failed_; }
  [[nodiscard]] std::int64_t size_bytes() const noexcept;
  /// Between the first frame and this one.
  [[nodiscard]] double AgeAt_s(StampNs stamp_ns) noexcept;

  /// Writes what waits, and closes all. @param written Gets a line per output.
  /// @return What went wrong; empty: nothing.
  [[nodiscard]] std::string Finish(std::vector<std::string>& written);

 private:
  void Hand(const DepthFrame* frame, std::span<const FrameResult> results,
            const TrackedObjects& objects);

  std::deque<std::optional<TrajectoryCsv>> trajectories_;
  RecordingQueue* queue_;
  std::optional<RecordingWriter> recording_;
  bool recording_ended_ = false;  ///< By a failure, which has been said.
  ModelPace model_pace_;
  std::vector<SampleList> models_;  ///< Without a queue.
  std::string record_path_;
  std::optional<StampNs> first_ns_;
  bool failed_ = false;
};

}  // namespace disflow::apps
