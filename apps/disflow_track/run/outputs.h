// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "files/object_outputs.h"
#include "links/telemetry_output.h"
#include "objects/tracked_object.h"
#include "program/console.h"
#include "program/frame_result.h"
#include "run/part_maker.h"
#include "settings/options.h"

namespace disflow::apps {

/// Everything that a run writes and sends. An output that fails while running is said once; the
/// others go on. Objects and results are in the order of Options::objects.
class Outputs {
 public:
  /// Opens all that was asked for, so that a run never ends with nowhere to put its result.
  /// @throws Failure kWrongUsage, kOutputFailed; files that existed are then unchanged.
  /// @param named The options before NumberOutputs(); for rotated files, outlive this object.
  /// @param sensor Where the frames come from; outlives this object.
  /// @param camera_poses Where the links put the camera's poses; null if the camera stands.
  Outputs(const Options& options, const Options& named, const hal::SensorInfo& sensor,
          Console& console, hal::CameraPoseHistory* camera_poses);

  /// @param frame The input frame; null if it could not be read.
  void Deliver(const TrackedObjects& objects, std::span<const FrameResult> results,
               const DepthFrame* frame, std::int64_t age_ns, std::int64_t now_ns);
  /// The flow of the frame tracked last, for those who want it.
  void WriteFlow(const TrackedObjects& objects, std::span<const FrameResult> results);
  void WriteMeshes(const TrackedObjects& objects, double resolution_m);

  /// Takes what has come in on the links.
  /// @param capture_now_ns Now, on the clock of the depth images' stamps.
  void Receive(std::int64_t capture_now_ns) noexcept { telemetry_.Receive(capture_now_ns); }
  /// Answers what was asked on the links, after a frame.
  void Answer(const TrackedObjects& objects, std::span<const FrameResult> results) noexcept {
    telemetry_.Answer(objects, results);
  }
  /// What shows input when something has come in on the links.
  [[nodiscard]] std::span<const int> fds() noexcept { return telemetry_.fds(); }
  void KeepAlive(std::int64_t now_ns) noexcept { telemetry_.KeepAlive(now_ns); }
  /// Frames that the recordings lack because the disk did not keep up.
  [[nodiscard]] std::uint32_t recording_dropped() const noexcept {
    return queue_ ? queue_->dropped() : 0;
  }

  /// Closes all. @return false if something that was asked for is not complete.
  [[nodiscard]] bool Finish();
  /// @return One line per output, after Finish().
  [[nodiscard]] const std::vector<std::string>& written() const noexcept { return written_; }

 private:
  void RotateIfFull(StampNs stamp_ns);
  void SayIfDiskIsSlow();
  [[nodiscard]] bool IsFull(StampNs stamp_ns) noexcept;
  template <class Write>
  void Attempt(Write&& write);
  void Fail(const std::string& message);

  Console& console_;
  TelemetryOutput telemetry_;
  std::deque<ObjectOutputs> objects_;
  RotationOptions rotation_;
  bool waits_for_files_;                   ///< Nothing is lost meanwhile.
  std::unique_ptr<RecordingQueue> queue_;  ///< Null: nothing is recorded, or files are waited for.
  bool disk_is_slow_ = false;              ///< It has been said.
  std::unique_ptr<RunPart> part_;
  std::unique_ptr<PartMaker> maker_;  ///< Null: nothing is rotated.
  std::vector<std::string> written_;
  bool complete_ = true;
};

}  // namespace disflow::apps
