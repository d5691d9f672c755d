// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace disflow::apps {

/// A fixed number of threads that share out work with the thread that calls. Nothing is allocated
/// after the start.
class WorkerPool {
 public:
  /// @param workers Threads beside the caller's; 0 = the caller does all.
  /// @param prepare Called in each new thread, with its number.
  WorkerPool(int workers, const std::function<void(int worker)>& prepare);
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool();

  /// Calls job(i) for every i below count, in any order and in any of the threads, and returns when
  /// all are done.
  /// @param job Does not throw.
  template <class Job>
  void ForEach(std::size_t count, const Job& job) noexcept {
    Run({.call = [](const void* context,
                    std::size_t i) noexcept { (*static_cast<const Job*>(context))(i); },
         .context = &job,
         .count = count});
  }

 private:
  struct Task {
    void (*call)(const void* context, std::size_t i) noexcept = nullptr;
    const void* context = nullptr;
    std::size_t count = 0;
  };

  void Run(const Task& task) noexcept;
  void Work(std::unique_lock<std::mutex>& lock) noexcept;
  void Serve() noexcept;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::condition_variable done_;
  // Under the mutex.
  Task task_;
  std::size_t next_ = 0;  ///< The first that nobody has begun.
  std::size_t unfinished_ = 0;
  bool stop_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace disflow::apps
