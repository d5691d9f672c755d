// SPDX-License-Identifier: BSD-3-Clause
#include "run/recording.h"

#include <utility>

#include "dds/bag_recording.h"
#include "disflow/host/sequence_writer.h"
#include "files/numbered_names.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

/// A sequence for `replay:`.
class FolderRecording final : public Recording {
 public:
  explicit FolderRecording(const std::string& path) {
    const hal::Fault fault = writer_.Open(path, "object", /*overwrite=*/false);
    if (fault.status == Status::kBusy) {
      throw Failure(kOutputFailed,
                    path + ": is not empty, and a recording is never overwritten; " + kOtherFolder);
    }
    Require(fault);
  }

  [[nodiscard]] hal::Fault Add(const RecordedFrame& recorded) override {
    if (recorded.frame == nullptr) return {};
    const DepthFrame& frame = *recorded.frame;
    hal::Fault fault = writer_.AddFrame(frame);
    if (fault.ok() && frame.mask.given()) fault = writer_.AddMask("gt", frame.mask);
    // At once: the next frame may never come.
    return fault.ok() ? writer_.CompleteFrame() : fault;
  }
  [[nodiscard]] hal::Fault Finish() override { return writer_.Finish(); }
  [[nodiscard]] int frame_count() const noexcept override { return writer_.frame_count(); }
  [[nodiscard]] std::int64_t size_bytes() const noexcept override { return writer_.image_bytes(); }
  [[nodiscard]] bool has_results() const noexcept override { return false; }

 private:
  host::SequenceWriter writer_;
};

/// Messages of ROS 2.
class MessageRecording final : public Recording {
 public:
  MessageRecording(const Options& options, const hal::SensorInfo& sensor) : bag_(options, sensor) {}

  [[nodiscard]] hal::Fault Add(const RecordedFrame& recorded) override {
    return bag_.Add(recorded.frame, recorded.results, recorded.models);
  }
  [[nodiscard]] hal::Fault Finish() override { return bag_.Finish(); }
  [[nodiscard]] int frame_count() const noexcept override { return bag_.frame_count(); }
  [[nodiscard]] std::int64_t size_bytes() const noexcept override { return bag_.size_bytes(); }
  [[nodiscard]] bool has_results() const noexcept override { return true; }

 private:
  BagRecording bag_;
};

}  // namespace

std::unique_ptr<Recording> OpenRecording(const Options& options, const hal::SensorInfo& sensor) {
  if (BagRecording::IsMeant(options.record))
    return std::make_unique<MessageRecording>(options, sensor);
  return std::make_unique<FolderRecording>(options.record);
}

bool ModelPace::IsDue(StampNs stamp_ns) const noexcept {
  // Stamps that run backwards belong to what is played again.
  return !last_ns_ || stamp_ns < *last_ns_ || stamp_ns - *last_ns_ >= kModelPeriod_ns;
}

RecordingWriter::RecordingWriter(std::unique_ptr<Recording> recording)
    : has_results_(recording->has_results()),
      recording_(std::move(recording)),
      bytes_(recording_->size_bytes()) {}

void RecordingWriter::Write(const RecordedFrame& frame) {
  if (failed_) return;
  const hal::Fault fault = recording_->Add(frame);
  frames_ = recording_->frame_count();
  bytes_ = recording_->size_bytes();
  if (fault.ok()) return;
  failure_ = std::string(fault.message) + "; nothing more is recorded after " +
             std::to_string(frames_) + " frames";
  recording_.reset();
  failed_ = true;
}

}  // namespace disflow::apps
