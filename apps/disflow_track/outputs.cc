// SPDX-License-Identifier: BSD-3-Clause
#include "outputs.h"

#include <cstring>

#include "exit_status.h"

namespace disflow::apps {

Outputs::Outputs(const Options& options, Console& console)
    : console_(console),
      telemetry_(options.links, options.object_index, console),
      mesh_path_(options.mesh),
      record_path_(options.record) {
  if (!options.mesh.empty()) mesh_.emplace(options.mesh);
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

void Outputs::WriteMesh(const SurfaceMesh& mesh) {
  if (mesh.triangle_count() == 0) {
    Fail(mesh_path_ + ": not written, no surface was reconstructed");
    return;
  }
  try {
    mesh_->Commit(mesh.FormatPly());
  } catch (const Failure& failure) {
    Fail(failure.what());
    return;
  }
  written_.push_back(mesh_path_ + ": " + std::to_string(mesh.vertices().size()) + " vertices, " +
                     std::to_string(mesh.triangle_count()) + " triangles");
}

bool Outputs::Finish() {
  if (csv_) written_.push_back(csv_->file().path() + ": trajectory");
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
