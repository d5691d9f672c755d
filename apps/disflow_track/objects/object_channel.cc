// SPDX-License-Identifier: BSD-3-Clause
#include "objects/object_channel.h"

#include <chrono>

#include "disflow/saturating.h"

namespace disflow::apps {

void NewsSignal::Raise() noexcept {
  {
    const std::lock_guard lock(mutex_);
    raised_ = true;
  }
  changed_.notify_one();
}

bool NewsSignal::WaitFor(std::int64_t timeout_ns) {
  std::unique_lock lock(mutex_);
  const bool raised =
      changed_.wait_for(lock, std::chrono::nanoseconds(timeout_ns), [this] { return raised_; });
  raised_ = false;
  return raised;
}

bool ChannelReader::Pop(FrameResult& result) {
  const std::lock_guard lock(mutex_);
  if (count_ == 0) return false;
  result = results_[first_];
  first_ = (first_ + 1) % kResults;
  --count_;
  return true;
}

std::uint32_t ChannelReader::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

void ChannelReader::Push(const FrameResult& result) noexcept {
  const std::lock_guard lock(mutex_);
  if (count_ == kResults) {
    first_ = (first_ + 1) % kResults;
    --count_;
    AddSaturating(lost_);
  }
  results_[(first_ + count_) % kResults] = result;
  ++count_;
}

ChannelReader& ObjectChannel::AddReader(NewsSignal& signal) {
  return readers_.emplace_back(signal, new_snapshot_());
}

void ObjectChannel::Choose(ObjectChoice choice) {
  const std::lock_guard lock(choice_mutex_);
  std::swap(choice_, choice);
  chosen_ = true;
}

bool ObjectChannel::TakeChoice(ObjectChoice& choice) noexcept {
  if (!chosen_) return false;
  // Whoever holds it is about to choose something newer, for the next frame.
  const std::unique_lock lock(choice_mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return false;
  chosen_ = false;
  std::swap(choice_, choice);
  return true;
}

}  // namespace disflow::apps
