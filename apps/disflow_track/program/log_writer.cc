// SPDX-License-Identifier: BSD-3-Clause
#include "program/log_writer.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "disflow/saturating.h"

namespace disflow::apps {
LogWriter::LogWriter(LogTarget& target) : target_(target), thread_([this] { WriteAll(); }) {}

LogWriter::~LogWriter() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void LogWriter::Push(std::string_view text) noexcept {
  {
    const std::lock_guard lock(mutex_);
    if (count_ == kEntries) {
      AddSaturating(lost_);
      return;
    }
    Entry& entry = entries_[(first_ + count_) % kEntries];
    entry.size = std::min(text.size(), kLongest);
    std::memcpy(entry.text.data(), text.data(), entry.size);
    // Whoever reads lines shall not find two in one.
    if (text.size() > kLongest && text.back() == '\n') entry.text[kLongest - 1] = '\n';
    ++count_;
  }
  changed_.notify_one();
}

void LogWriter::WriteAll() {
  Entry entry;
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return count_ > 0 || ending_; });
    if (count_ == 0) return;
    entry = entries_[first_];
    first_ = (first_ + 1) % kEntries;
    --count_;
    const std::uint32_t lost = count_ == 0 ? std::exchange(lost_, 0) : 0;
    lock.unlock();
    target_.Write({entry.text.data(), entry.size});
    if (lost > 0) target_.WriteLost(lost);
    lock.lock();
  }
}

}  // namespace disflow::apps
