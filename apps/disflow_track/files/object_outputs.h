// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/flow_output.h"
#include "files/mesh_output.h"
#include "objects/tracked_object.h"
#include "program/frame_result.h"
#include "settings/object_options.h"

namespace disflow::apps {

/// The files that a run writes for one object, but for its trajectory. One that fails while running
/// is left alone; the others go on.
class ObjectOutputs {
 public:
  /// @throws Failure kOutputFailed.
  explicit ObjectOutputs(const ObjectFiles& files) : mesh_(files.mesh, files.mesh_picture) {
    if (!files.flow.empty()) flow_.emplace(files.flow);
  }

  /// The flow of the frame tracked last. @throws Failure kOutputFailed, once.
  void WriteFlow(const TrackedObject& object, const FrameResult& result);
  /// The surface. @throws Failure kOutputFailed.
  void WriteMesh(TrackedObject& object, double resolution_m, std::vector<std::string>& written);

  /// @param written Gets a line per output.
  void Finish(std::vector<std::string>& written);

 private:
  MeshOutput mesh_;
  std::optional<FlowOutput> flow_;  ///< Empty again after a failure.
};

}  // namespace disflow::apps
