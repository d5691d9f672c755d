// SPDX-License-Identifier: BSD-3-Clause
#include "run/recording_queue.h"

#include <sys/eventfd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "disflow/posix/quiet_thread.h"
#include "disflow/saturating.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

std::size_t CapacityFor(const RecordingQueue::Room& room) {
  constexpr std::size_t kFewestFrames = 2;
  constexpr std::size_t kMaskPixel_bytes = 1;
  const std::size_t pixels =
      static_cast<std::size_t>(room.width_px) * static_cast<std::size_t>(room.height_px);
  const std::size_t frame_bytes = pixels * (FrameCopy::kLargestPixel_bytes + kMaskPixel_bytes);
  return std::clamp(RecordingQueue::kMostBytes / std::max<std::size_t>(frame_bytes, 1),
                    kFewestFrames, RecordingQueue::kMostFrames);
}

}  // namespace

RecordingQueue::RecordingQueue(const Room& room)
    : slots_(CapacityFor(room)), waiting_(::eventfd(0, EFD_CLOEXEC | EFD_SEMAPHORE)) {
  if (!waiting_.is_open()) {
    throw Failure(kOutputFailed,
                  std::string("recording: no thread can be woken: ") + std::strerror(errno));
  }
  for (Slot& slot : slots_) {
    // Masks may come from elsewhere than the sensor, and later.
    slot.image.Reserve(room.width_px, room.height_px, /*with_mask=*/true);
    slot.results.resize(room.objects);
  }
  if (room.model_samples > 0) {
    for (std::vector<SampleList>& models : models_) {
      models = std::vector<SampleList>(room.objects);
      for (SampleList& model : models) model.Reserve(room.model_samples);
    }
  }
  thread_ = posix::StartQuietThread([this] { Work(); });
}

RecordingQueue::~RecordingQueue() {
  // One more than there are frames.
  (void)::eventfd_write(waiting_.get(), 1);
  thread_.join();
}

RecordingQueue::Taken RecordingQueue::Put(RecordingWriter& writer, const DepthFrame* frame,
                                          std::span<const FrameResult> results,
                                          const TrackedObjects* objects) {
  if (put_ - written_ == slots_.size()) {
    std::uint32_t dropped = dropped_;
    AddSaturating(dropped);
    dropped_ = dropped;
    return {};
  }
  Slot& slot = slots_[next_slot_];
  slot.writer = &writer;
  slot.readable = frame != nullptr;
  if (frame != nullptr) slot.image.Take(*frame);
  slot.result_count = std::min(results.size(), slot.results.size());
  std::copy_n(results.begin(), slot.result_count, slot.results.begin());
  slot.models = nullptr;
  if (objects != nullptr && models_waiting_ < models_.size()) {
    std::vector<SampleList>& models = models_[next_models_];
    for (std::size_t i = 0; i < models.size(); ++i) models[i].Take(*(*objects)[i]);
    slot.models = &models;
    next_models_ = (next_models_ + 1) % models_.size();
    ++models_waiting_;
  }
  next_slot_ = (next_slot_ + 1) % slots_.size();
  const bool with_models = slot.models != nullptr;
  ++put_;
  (void)::eventfd_write(waiting_.get(), 1);
  return {true, with_models};
}

void RecordingQueue::AwaitWritten() {
  const std::uint32_t end = put_;
  std::unique_lock lock(mutex_);
  // The counters may wrap.
  is_written_.wait(lock, [this, end] { return static_cast<std::int32_t>(written_ - end) >= 0; });
}

RecordedFrame RecordingQueue::ViewOf(const Slot& slot) {
  RecordedFrame view;
  if (slot.readable) view.frame = &slot.image.frame();
  view.results = std::span(slot.results).first(slot.result_count);
  if (slot.models != nullptr) view.models = *slot.models;
  return view;
}

void RecordingQueue::Work() {
  for (std::size_t next = 0;; next = (next + 1) % slots_.size()) {
    eventfd_t count = 0;
    while (::eventfd_read(waiting_.get(), &count) != 0) {
    }
    if (put_ == written_) return;
    const Slot& slot = slots_[next];
    slot.writer->Write(ViewOf(slot));
    if (slot.models != nullptr) --models_waiting_;
    {
      const std::lock_guard lock(mutex_);
      ++written_;
    }
    is_written_.notify_all();
  }
}

}  // namespace disflow::apps
