// SPDX-License-Identifier: BSD-3-Clause
#include "run/outputs.h"

#include <utility>

#include "dds/bag_recording.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

std::unique_ptr<RecordingQueue> MakeQueue(const Options& options, const hal::SensorInfo& sensor) {
  RecordingQueue::Room room{.width_px = sensor.width_px, .height_px = sensor.height_px};
  if (BagRecording::IsMeant(options.record)) {
    room.objects = options.objects.size();
    room.model_samples = MaxModelSamples(options.profile);
  }
  return std::make_unique<RecordingQueue>(room);
}

}  // namespace

Outputs::Outputs(const Options& options, const Options& named, const hal::SensorInfo& sensor,
                 Console& console, hal::CameraPoseHistory* camera_poses)
    : console_(console),
      telemetry_(options, sensor, camera_poses, console),
      rotation_(options.rotation),
      waits_for_files_(!sensor.live && options.rate != Rate::kLive) {
  for (const ObjectOptions& object : options.objects) objects_.emplace_back(object.files);
  // Last, since it empties files that may exist.
  if (!options.record.empty() && !waits_for_files_) queue_ = MakeQueue(options, sensor);
  part_ = std::make_unique<RunPart>(options, sensor, queue_.get());
  if (rotation_.wanted())
    maker_ = std::make_unique<PartMaker>(named, sensor, queue_.get(), console);
}

void Outputs::Deliver(const TrackedObjects& objects, std::span<const FrameResult> results,
                      const DepthFrame* frame, std::int64_t age_ns, std::int64_t now_ns) {
  telemetry_.Send(results, age_ns, now_ns);
  if (maker_) RotateIfFull(results.front().estimate.stamp_ns);
  for (std::size_t i = 0; i < objects_.size(); ++i)
    Attempt([&] { part_->WriteRow(i, results[i]); });
  Attempt([&] { part_->Record(frame, results, objects); });
  SayIfDiskIsSlow();
}

void Outputs::SayIfDiskIsSlow() {
  if (disk_is_slow_ || recording_dropped() == 0) return;
  disk_is_slow_ = true;
  Fail(
      "recording: the disk does not keep up; frames are left out of the recording until it does, "
      "tracking goes on; see docs/sequences.md");
}

void Outputs::RotateIfFull(StampNs stamp_ns) {
  if (!IsFull(stamp_ns)) return;
  // Until they are there, the full ones take what comes.
  std::unique_ptr<RunPart> next = maker_->Take(waits_for_files_);
  if (!next) return;
  std::swap(part_, next);
  (void)part_->AgeAt_s(stamp_ns);  // counts from here
  maker_->Retire(std::move(next));
}

bool Outputs::IsFull(StampNs stamp_ns) noexcept {
  constexpr double kMegabyte = 1e6;
  const double size_mb = static_cast<double>(part_->size_bytes()) / kMegabyte;
  const double age_s = part_->AgeAt_s(stamp_ns);
  return part_->has_failed() || (rotation_.size_mb > 0.0 && size_mb >= rotation_.size_mb) ||
         (rotation_.age_s > 0.0 && age_s >= rotation_.age_s);
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
  const std::string failure = part_->Finish(written_);
  if (!failure.empty()) Fail(failure);
  if (maker_) {
    complete_ = maker_->Finish() && complete_;
    if (maker_->retired() > 0) {
      written_.push_back("and " + std::to_string(maker_->retired()) +
                         " times before, under lower numbers");
    }
  }
  if (recording_dropped() > 0) {
    written_.push_back("recording: " + std::to_string(recording_dropped()) +
                       " frames left out because the disk did not keep up");
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
  console_.Say(message, Severity::kError);
}

}  // namespace disflow::apps
