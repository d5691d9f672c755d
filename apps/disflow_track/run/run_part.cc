// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_part.h"

#include <cstring>

#include "program/exit_status.h"

namespace disflow::apps {

RunPart::RunPart(const Options& options, const hal::SensorInfo& sensor, RecordingQueue* queue)
    : queue_(queue), models_(options.objects.size()), record_path_(options.record) {
  if (!options.record.empty()) recording_.emplace(OpenRecording(options, sensor));
  // Last, since it empties files that may exist.
  for (const ObjectOptions& object : options.objects) {
    std::optional<TrajectoryCsv>& csv = trajectories_.emplace_back();
    if (!object.files.csv.empty()) csv.emplace(object.files.csv, options.timing);
  }
}

RunPart::~RunPart() {
  if (recording_ && queue_ != nullptr) queue_->AwaitWritten();
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
  if (!recording_ || recording_ended_) return;
  if (!recording_->has_failed()) {
    Hand(frame, results, objects);
    // What the queue makes of it is asked with the next frame.
    if (queue_ != nullptr || !recording_->has_failed()) return;
  }
  failed_ = true;
  recording_ended_ = true;
  throw Failure(kOutputFailed, recording_->failure());
}

void RunPart::Hand(const DepthFrame* frame, std::span<const FrameResult> results,
                   const TrackedObjects& objects) {
  if (!recording_->has_results()) {
    if (frame == nullptr) return;
    results = {};
  }
  bool with_models =
      recording_->has_results() && frame != nullptr && model_pace_.IsDue(frame->stamp_ns);
  if (queue_ != nullptr) {
    const TrackedObjects* const sources = with_models ? &objects : nullptr;
    with_models = queue_->Put(*recording_, frame, results, sources).models;
  } else {
    for (std::size_t i = 0; with_models && i < models_.size(); ++i) models_[i].Take(*objects[i]);
    std::span<const SampleList> models;
    if (with_models) models = models_;
    recording_->Write({frame, results, models});
  }
  if (with_models) model_pace_.Recorded(frame->stamp_ns);
}

std::int64_t RunPart::size_bytes() const noexcept {
  std::int64_t bytes = 0;
  for (const auto& csv : trajectories_) bytes += csv ? csv->file().size_bytes() : 0;
  if (recording_) bytes += recording_->size_bytes();
  return bytes;
}

double RunPart::AgeAt_s(StampNs stamp_ns) noexcept {
  // Stamps that begin anew, as those of a sequence that is played again, make it no older.
  if (!first_ns_ || stamp_ns < *first_ns_) first_ns_ = stamp_ns;
  return static_cast<double>(stamp_ns - *first_ns_) * 1e-9;
}

std::string RunPart::Finish(std::vector<std::string>& written) {
  for (const auto& csv : trajectories_)
    if (csv && csv->file().error() == 0) written.push_back(csv->file().path() + ": trajectory");
  if (!recording_ || recording_ended_) return {};
  if (queue_ != nullptr) queue_->AwaitWritten();
  recording_ended_ = true;
  if (recording_->has_failed()) return recording_->failure();
  const hal::Fault fault = recording_->Finish();
  if (!fault.ok()) return fault.message;
  written.push_back(record_path_ + ": " + std::to_string(recording_->frame_count()) + " frames");
  return {};
}

}  // namespace disflow::apps
