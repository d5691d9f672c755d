// SPDX-License-Identifier: BSD-3-Clause
#include "run/part_maker.h"

#include <utility>
#include <vector>

#include "disflow/posix/monotonic_clock.h"
#include "disflow/posix/quiet_thread.h"
#include "files/numbered_names.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

constexpr std::int64_t kRetry_ns = 5'000'000'000;

std::int64_t NowNs() { return posix::MonotonicClock().NowNs(); }

}  // namespace

PartMaker::PartMaker(const Options& named, const hal::SensorInfo& sensor, RecordingQueue* queue,
                     Console& console)
    : named_(named),
      sensor_(sensor),
      queue_(queue),
      console_(console),
      thread_(posix::StartQuietThread([this] { Work(); })) {}

PartMaker::~PartMaker() { (void)Finish(); }

std::unique_ptr<RunPart> PartMaker::Take(bool wait) {
  std::unique_lock lock(mutex_);
  if (!next_ && !wanted_ && NowNs() >= try_again_ns_) {
    wanted_ = true;
    changed_.notify_all();
  }
  if (wait) changed_.wait(lock, [this] { return !wanted_; });
  return std::move(next_);
}

void PartMaker::Retire(std::unique_ptr<RunPart> part) {
  ++retired_count_;
  {
    const std::lock_guard lock(mutex_);
    full_ = std::move(part);
  }
  changed_.notify_all();
}

bool PartMaker::Finish() {
  if (!thread_.joinable()) return complete_;
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
  return complete_;
}

void PartMaker::Work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return full_ || wanted_ || ending_; });
    // First, so that there is at most one.
    if (std::unique_ptr<RunPart> full = std::move(full_)) {
      lock.unlock();
      Close(std::move(full));
      lock.lock();
    } else if (ending_) {
      return;
    } else {
      lock.unlock();
      Open();
      lock.lock();
    }
  }
}

/// Not under the mutex.
void PartMaker::Open() {
  std::unique_ptr<RunPart> part;
  try {
    part = std::make_unique<RunPart>(NumberOutputs(named_), sensor_, queue_);
    failing_ = false;
  } catch (const Failure& failure) {
    Fail(std::string(failure.what()) + "; the files are not rotated, it is tried again");
  }
  const std::lock_guard lock(mutex_);
  if (!part) try_again_ns_ = NowNs() + kRetry_ns;
  next_ = std::move(part);
  wanted_ = false;
  changed_.notify_all();
}

void PartMaker::Close(std::unique_ptr<RunPart> part) {
  std::vector<std::string> written;
  const std::string incomplete = part->Finish(written);
  if (!incomplete.empty()) Fail(incomplete);
  part.reset();
  if (named_.rotation.keep == 0) return;
  try {
    RemoveOldOutputs(named_, named_.rotation.keep);
  } catch (const Failure& failure) {
    Fail(failure.what());
  }
}

void PartMaker::Fail(const std::string& message) {
  complete_ = false;
  if (!std::exchange(failing_, true)) console_.Say(message, Severity::kError);
}

}  // namespace disflow::apps
