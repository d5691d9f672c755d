// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "console.h"
#include "disflow/host/sequence_writer.h"
#include "flow_output.h"
#include "frame_result.h"
#include "mesh_output.h"
#include "options.h"
#include "telemetry_output.h"
#include "trajectory_csv.h"

namespace disflow::apps {

/// Everything that a run writes and sends. An output that fails while running is said once; the
/// others go on.
class Outputs {
 public:
  /// Opens all that was asked for, so that a run never ends with nowhere to put its result.
  /// @throws Failure kWrongUsage, kOutputFailed; files that existed are then unchanged.
  /// @param camera_poses Where the links put the camera's poses; null if the camera stands.
  Outputs(const Options& options, Console& console, hal::CameraPoseHistory* camera_poses);

  /// @param frame The input frame; null if it could not be read.
  void Deliver(const FrameResult& result, const DepthFrame* frame, std::int64_t age_ns,
               std::int64_t now_ns);
  /// Takes what has come in on the links.
  void Receive(std::int64_t now_ns) noexcept { telemetry_.Receive(now_ns); }
  void KeepAlive(std::int64_t now_ns) noexcept { telemetry_.KeepAlive(now_ns); }

  /// Where the flow of a frame goes before WriteFlow(); null if it is not wanted.
  [[nodiscard]] FlowCloud* flow() noexcept { return flow_ ? &flow_->cloud() : nullptr; }
  void WriteFlow(const FrameResult& result);

  [[nodiscard]] bool wants_mesh() const noexcept { return mesh_.wanted(); }
  void WriteMesh(const SurfaceMesh& mesh);

  /// Closes all. @return false if something that was asked for is not complete.
  [[nodiscard]] bool Finish();
  /// @return One line per output, after Finish().
  [[nodiscard]] const std::vector<std::string>& written() const noexcept { return written_; }

 private:
  void StartRecording(const std::string& folder);
  [[nodiscard]] hal::Fault Record(const DepthFrame& frame);
  void Fail(const std::string& message);

  Console& console_;
  TelemetryOutput telemetry_;
  MeshOutput mesh_;
  std::optional<FlowOutput> flow_;                 ///< Empty again after a failure.
  std::optional<host::SequenceWriter> recording_;  ///< Empty again after a failure.
  std::optional<TrajectoryCsv> csv_;
  std::string record_path_;
  std::vector<std::string> written_;
  bool complete_ = true;
};

}  // namespace disflow::apps
