// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_part.h"

#include <cstring>

#include "files/numbered_names.h"
#include "program/exit_status.h"

namespace disflow::apps {

RunPart::RunPart(const Options& options, const hal::SensorInfo& sensor)
    : record_path_(options.record) {
  if (!options.record.empty()) StartRecording(options, sensor);
  // Last, since it empties files that may exist.
  for (const ObjectOptions& object : options.objects) {
    std::optional<TrajectoryCsv>& csv = trajectories_.emplace_back();
    if (!object.files.csv.empty()) csv.emplace(object.files.csv, options.timing);
  }
}

void RunPart::StartRecording(const Options& options, const hal::SensorInfo& sensor) {
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

void RunPart::WriteRow(std::size_t object, const FrameResult& result) {
  std::optional<TrajectoryCsv>& csv = trajectories_[object];
  if (!csv || csv->file().error() != 0 || csv->Write(result)) return;
  failed_ = true;
  throw Failure(kOutputFailed, csv->file().path() +
                                   ": cannot be written: " + std::strerror(csv->file().error()) +
                                   "; it ends before frame " + std::to_string(result.frame));
}

void RunPart::Record(const DepthFrame* frame, std::span<const FrameResult> results,
                     const TrackedObjects& objects) {
  if (!recording_ && !bag_) return;
  const hal::Fault fault = bag_ ? bag_->Add(frame, results, objects) : AddToSequence(frame);
  if (fault.ok()) return;
  failed_ = true;
  const std::string end = std::string(fault.message) + "; nothing more is recorded after " +
                          std::to_string(recorded_frames()) + " frames";
  recording_.reset();
  bag_.reset();
  throw Failure(kOutputFailed, end);
}

hal::Fault RunPart::AddToSequence(const DepthFrame* frame) {
  if (frame == nullptr) return {};
  hal::Fault fault = recording_->AddFrame(*frame);
  if (fault.ok() && frame->mask.given()) fault = recording_->AddMask("gt", frame->mask);
  // At once: the next frame may never come.
  return fault.ok() ? recording_->CompleteFrame() : fault;
}

int RunPart::recorded_frames() const noexcept {
  return bag_ ? bag_->frame_count() : recording_->frame_count();
}

std::int64_t RunPart::size_bytes() const noexcept {
  std::int64_t bytes = 0;
  for (const auto& csv : trajectories_) bytes += csv ? csv->file().size_bytes() : 0;
  if (recording_) bytes += recording_->image_bytes();
  if (bag_) bytes += bag_->size_bytes();
  return bytes;
}

double RunPart::AgeAt_s(StampNs stamp_ns) noexcept {
  // Stamps that begin anew, as those of a sequence that is played again, make it no older.
  if (!first_ns_ || stamp_ns < *first_ns_) first_ns_ = stamp_ns;
  return static_cast<double>(stamp_ns - *first_ns_) * 1e-9;
}

hal::Fault RunPart::Finish(std::vector<std::string>& written) {
  for (const auto& csv : trajectories_)
    if (csv) written.push_back(csv->file().path() + ": trajectory");
  if (!recording_ && !bag_) return {};
  const hal::Fault fault = bag_ ? bag_->Finish() : recording_->Finish();
  written.push_back(record_path_ + ": " + std::to_string(recorded_frames()) + " frames");
  return fault;
}

}  // namespace disflow::apps
