// SPDX-License-Identifier: BSD-3-Clause
#include "run/outputs.h"

#include "files/numbered_names.h"
#include "program/exit_status.h"

namespace disflow::apps {

Outputs::Outputs(const Options& options, const hal::SensorInfo& sensor, Console& console,
                 hal::CameraPoseHistory* camera_poses)
    : console_(console),
      telemetry_(options, sensor, camera_poses, console),
      record_path_(options.record) {
  for (const ObjectOptions& object : options.objects) objects_.emplace_back(object.files);
  if (!options.record.empty()) StartRecording(options, sensor);
  // Last, since it empties files that may exist.
  for (ObjectOutputs& object : objects_) object.OpenTrajectory(options.timing);
}

void Outputs::StartRecording(const Options& options, const hal::SensorInfo& sensor) {
  constexpr const char* kObject = "object";
  if (BagRecording::IsMeant(options.record)) {
    bag_.emplace(options, sensor);
    return;
  }
  recording_.emplace();
  const hal::Fault fault = recording_->Open(options.record, kObject, /*overwrite=*/false);
  if (fault.status == Status::kBusy) {
    throw Failure(
        kOutputFailed,
        options.record + ": is not empty, and a recording is never overwritten; " + kOtherFolder);
  }
  Require(fault);
}

void Outputs::Deliver(std::span<const FrameResult> results, const DepthFrame* frame,
                      std::int64_t age_ns, std::int64_t now_ns) {
  telemetry_.Send(results, age_ns, now_ns);
  for (std::size_t i = 0; i < objects_.size(); ++i)
    Attempt([&] { objects_[i].WriteRow(results[i]); });
  if (!is_recording()) return;
  const hal::Fault fault = Record(frame, results);
  if (fault.ok()) return;
  Fail(std::string(fault.message) + "; nothing more is recorded after " +
       std::to_string(recorded_frames()) + " frames");
  recording_.reset();
  bag_.reset();
}

hal::Fault Outputs::Record(const DepthFrame* frame, std::span<const FrameResult> results) {
  if (bag_) return bag_->Add(frame, results);
  if (frame == nullptr) return {};
  hal::Fault fault = recording_->AddFrame(*frame);
  if (fault.ok() && frame->mask.given()) fault = recording_->AddMask("gt", frame->mask);
  // At once: the next frame may never come.
  return fault.ok() ? recording_->CompleteFrame() : fault;
}

int Outputs::recorded_frames() const noexcept {
  return bag_ ? bag_->frame_count() : recording_->frame_count();
}

void Outputs::WriteFlow(const TrackedObjects& objects, std::span<const FrameResult> results) {
  for (std::size_t i = 0; i < objects_.size(); ++i)
    Attempt([&] { objects_[i].WriteFlow(*objects[i], results[i]); });
}

void Outputs::WriteMeshes(const TrackedObjects& objects, double resolution_m) {
  for (std::size_t i = 0; i < objects_.size(); ++i)
    Attempt([&] { objects_[i].WriteMesh(*objects[i], resolution_m, written_); });
}

bool Outputs::Finish() {
  for (ObjectOutputs& object : objects_) object.Finish(written_);
  if (is_recording()) {
    const hal::Fault fault = bag_ ? bag_->Finish() : recording_->Finish();
    if (!fault.ok()) Fail(fault.message);
    written_.push_back(record_path_ + ": " + std::to_string(recorded_frames()) + " frames");
  }
  for (std::string& line : telemetry_.Summary()) written_.push_back(std::move(line));
  return complete_ && !telemetry_.AnyLost();
}

template <class Write>
void Outputs::Attempt(Write&& write) {
  try {
    write();
  } catch (const Failure& failure) {
    Fail(failure.what());
  }
}

void Outputs::Fail(const std::string& message) {
  complete_ = false;
  console_.Say(message);
}

}  // namespace disflow::apps
