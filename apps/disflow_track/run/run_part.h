// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dds/bag_recording.h"
#include "disflow/host/sequence_writer.h"
#include "files/trajectory_csv.h"
#include "program/frame_result.h"
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
  RunPart(const Options& options, const hal::SensorInfo& sensor);
  RunPart(const RunPart&) = delete;
  RunPart& operator=(const RunPart&) = delete;

  /// A row of an object's trajectory. @throws Failure kOutputFailed, once.
  void WriteRow(std::size_t object, const FrameResult& result);
  /// @param frame Null if it could not be read. @throws Failure kOutputFailed, once.
  void Record(const DepthFrame* frame, std::span<const FrameResult> results,
              const TrackedObjects& objects);

  /// Whether something of it could not be written.
  [[nodiscard]] bool has_failed() const noexcept { return failed_; }
  [[nodiscard]] std::int64_t size_bytes() const noexcept;
  /// Between the first frame and this one.
  [[nodiscard]] double AgeAt_s(StampNs stamp_ns) noexcept;

  /// Closes all. @param written Gets a line per output.
  [[nodiscard]] hal::Fault Finish(std::vector<std::string>& written);

 private:
  void StartRecording(const Options& options, const hal::SensorInfo& sensor);
  [[nodiscard]] hal::Fault AddToSequence(const DepthFrame* frame);
  [[nodiscard]] int recorded_frames() const noexcept;

  std::deque<std::optional<TrajectoryCsv>> trajectories_;
  // At most one of them; empty again after a failure.
  std::optional<host::SequenceWriter> recording_;
  std::optional<BagRecording> bag_;
  std::string record_path_;
  std::optional<StampNs> first_ns_;
  bool failed_ = false;
};

}  // namespace disflow::apps
