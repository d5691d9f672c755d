// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/flow_output.h"
#include "files/mesh_output.h"
#include "files/trajectory_csv.h"
#include "objects/tracked_object.h"
#include "program/frame_result.h"
#include "settings/object_options.h"

namespace disflow::apps {

/// The files that a run writes for one object. One that fails while running is left alone; the
/// others go on.
class ObjectOutputs {
 public:
  /// Opens all but the trajectory. @throws Failure kOutputFailed.
  explicit ObjectOutputs(const ObjectFiles& files)
      : files_(files), mesh_(files.mesh, files.mesh_picture) {
    if (!files.flow.empty()) flow_.emplace(files.flow);
  }

  /// Empties the file, if there is one. @throws Failure kOutputFailed.
  /// @param timing See TrajectoryCsv.
  void OpenTrajectory(bool timing) {
    if (!files_.csv.empty()) csv_.emplace(files_.csv, timing);
  }

  /// A row of the trajectory. @throws Failure kOutputFailed, once.
  void WriteRow(const FrameResult& result);
  /// The flow of the frame tracked last. @throws Failure kOutputFailed, once.
  void WriteFlow(const TrackedObject& object, const FrameResult& result);
  /// The surface. @throws Failure kOutputFailed.
  void WriteMesh(TrackedObject& object, double resolution_m, std::vector<std::string>& written);

  /// @param written Gets a line per output.
  void Finish(std::vector<std::string>& written);

 private:
  const ObjectFiles& files_;
  MeshOutput mesh_;
  std::optional<FlowOutput> flow_;  ///< Empty again after a failure.
  std::optional<TrajectoryCsv> csv_;
};

}  // namespace disflow::apps
