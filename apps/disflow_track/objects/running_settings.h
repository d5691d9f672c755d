// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "disflow/config.h"

namespace disflow::apps {

/// The settings of a running tracker, as other threads read and change them. The tracking thread
/// takes them between two frames, never waits and does not allocate.
class RunningSettings {
 public:
  explicit RunningSettings(const Config& config) : now_(config) {}

  // By any thread.
  /// As they hold, or will from the next frame on.
  [[nodiscard]] Config Now() const;
  /// Lets a function change a copy, which holds from the next frame on. Settings that may not
  /// change at run time stay as they are.
  /// @param edit Called with Config&. May not use this object.
  /// @return What is wrong with the whole; nothing changes then.
  template <class Edit>
  ConfigIssue Change(Edit&& edit) {
    const std::lock_guard lock(mutex_);
    Config wanted = now_;
    edit(wanted);
    return Adopt(wanted);
  }
  /// Sets one.
  /// @param number Its place in VisitFields(), from 0. Numbers that no setting has, settings that
  /// may not change at run time, values out of range and broken whole numbers change nothing.
  /// @return Whether it was set.
  bool Set(std::size_t number, double value);
  /// Another one after each change.
  [[nodiscard]] std::uint32_t version() const noexcept { return version_; }

  /// By the tracking thread. @return false, and `config` is unchanged, if there is nothing new.
  [[nodiscard]] bool Take(Config& config) noexcept;

 private:
  ConfigIssue Adopt(const Config& wanted);

  mutable std::mutex mutex_;
  Config now_;  ///< Under the mutex.
  std::atomic<bool> is_new_ = false;
  std::atomic<std::uint32_t> version_ = 0;
};

}  // namespace disflow::apps
