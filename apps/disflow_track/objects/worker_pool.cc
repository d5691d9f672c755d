// SPDX-License-Identifier: BSD-3-Clause
#include "objects/worker_pool.h"

namespace disflow::apps {

WorkerPool::WorkerPool(int workers, const std::function<void(int worker)>& prepare) {
  threads_.reserve(static_cast<std::size_t>(workers));
  for (int worker = 0; worker < workers; ++worker) {
    threads_.emplace_back([this, prepare, worker] {
      prepare(worker);
      Serve();
    });
  }
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::Run(const Task& task) noexcept {
  std::unique_lock lock(mutex_);
  task_ = task;
  next_ = 0;
  unfinished_ = task.count;
  if (task.count > 1) changed_.notify_all();
  Work(lock);
  done_.wait(lock, [this] { return unfinished_ == 0; });
}

/// Takes what nobody has begun, until nothing is left.
void WorkerPool::Work(std::unique_lock<std::mutex>& lock) noexcept {
  while (next_ < task_.count) {
    const std::size_t mine = next_++;
    const Task task = task_;
    lock.unlock();
    task.call(task.context, mine);
    lock.lock();
    if (--unfinished_ == 0) done_.notify_one();
  }
}

void WorkerPool::Serve() noexcept {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stop_ || next_ < task_.count; });
    if (stop_) return;
    Work(lock);
  }
}

}  // namespace disflow::apps
