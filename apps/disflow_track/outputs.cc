// SPDX-License-Identifier: BSD-3-Clause
#include "outputs.h"

#include <cstring>

#include "exit_status.h"

namespace disflow::apps {

Outputs::Outputs(const Options& options, Console& console, hal::CameraPoseHistory* camera_poses)
    : console_(console),
      telemetry_(options, camera_poses, console),
      mesh_(options.mesh, options.mesh_picture),
      record_path_(options.record) {
  if (!options.flow.empty()) flow_.emplace(options.flow);
  if (!options.record.empty()) StartRecording(options.record);
  // Last, since it empties a file that may exist.
  if (!options.csv.empty()) csv_.emplace(options.csv, options.timing);
}

void Outputs::StartRecording(const std::string& folder) {
  constexpr const char* kObject = "object";
  recording_.emplace();
  const hal::Fault fault = recording_->Open(folder, kObject, /*overwrite=*/false);
  if (!fault.ok()) throw Failure(kOutputFailed, fault.message);
}

void Outputs::Deliver(const FrameResult& result, const DepthFrame* frame, std::int64_t age_ns,
                      std::int64_t now_ns) {
  telemetry_.Send(result, age_ns, now_ns);
  if (csv_ && csv_->file().error() == 0 && !csv_->Write(result)) {
    Fail(csv_->file().path() + ": cannot be written: " + std::strerror(csv_->file().error()) +
         "; it ends before frame " + std::to_string(result.frame));
  }
  if (!recording_ || frame == nullptr) return;
  const hal::Fault fault = Record(*frame);
  if (fault.ok()) return;
  Fail(std::string(fault.message) + "; nothing more is recorded");
  recording_.reset();
}

hal::Fault Outputs::Record(const DepthFrame& frame) {
  const hal::Fault fault = recording_->AddFrame(frame);
  return fault.ok() && frame.mask.given() ? recording_->AddMask("gt", frame.mask) : fault;
}

void Outputs::WriteFlow(const FrameResult& result) {
  try {
    flow_->Write(result.frame, result.estimate);
  } catch (const Failure& failure) {
    Fail(std::string(failure.what()) + "; no more flow is written");
    flow_.reset();
  }
}

void Outputs::WriteMesh(const SurfaceMesh& mesh) {
  try {
    for (std::string& line : mesh_.Write(mesh)) written_.push_back(std::move(line));
  } catch (const Failure& failure) {
    Fail(failure.what());
  }
}

bool Outputs::Finish() {
  if (csv_) written_.push_back(csv_->file().path() + ": trajectory");
  if (flow_) {
    written_.push_back(flow_->folder() + ": flow of " + std::to_string(flow_->files()) + " frames");
  }
  if (recording_) {
    const hal::Fault fault = recording_->Finish();
    if (!fault.ok()) Fail(fault.message);
    written_.push_back(record_path_ + ": " + std::to_string(recording_->frame_count()) + " frames");
  }
  for (std::string& line : telemetry_.Summary()) written_.push_back(std::move(line));
  return complete_ && !telemetry_.AnyLost();
}

void Outputs::Fail(const std::string& message) {
  complete_ = false;
  console_.Say(message);
}

}  // namespace disflow::apps
