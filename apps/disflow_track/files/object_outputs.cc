// SPDX-License-Identifier: BSD-3-Clause
#include "files/object_outputs.h"

#include "program/exit_status.h"

namespace disflow::apps {

void ObjectOutputs::WriteFlow(const TrackedObject& object, const FrameResult& result) {
  if (!flow_) return;
  FlowCloud& cloud = flow_->cloud();
  cloud.Clear();
  if (object.StreamFlow(result.estimate, cloud) == 0) return;
  try {
    flow_->Write(result.frame, result.estimate);
  } catch (const Failure& failure) {
    flow_.reset();
    throw Failure(failure.status(), std::string(failure.what()) + "; no more flow is written");
  }
}

void ObjectOutputs::WriteMesh(TrackedObject& object, double resolution_m,
                              std::vector<std::string>& written) {
  if (!mesh_.wanted()) return;
  SurfaceMesh mesh;
  object.ExtractMesh(resolution_m, mesh);
  for (std::string& line : mesh_.Write(mesh)) written.push_back(std::move(line));
}

void ObjectOutputs::Finish(std::vector<std::string>& written) {
  if (!flow_) return;
  written.push_back(flow_->folder() + ": flow of " + std::to_string(flow_->files()) + " frames");
}

}  // namespace disflow::apps
