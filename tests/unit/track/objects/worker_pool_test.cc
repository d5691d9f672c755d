// SPDX-License-Identifier: BSD-3-Clause
#include "objects/worker_pool.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <set>

namespace disflow::apps {
namespace {

TEST(WorkerPool, EveryPieceOfWork_IsDoneOnceBeforeTheCallReturns) {
  for (const int workers : {0, 1, 3}) {
    WorkerPool pool(workers, [](int) {});
    for (std::size_t count = 0; count < 9; ++count) {
      for (int round = 0; round < 200; ++round) {
        std::array<int, 9> done{};  // no atomics: the pool orders it
        const auto job = [&done](std::size_t i) noexcept { ++done[i]; };
        pool.ForEach(count, job);
        for (std::size_t i = 0; i < done.size(); ++i) ASSERT_EQ(done[i], i < count ? 1 : 0);
      }
    }
  }
}

TEST(WorkerPool, Workers_AndTheCallerWorkAtTheSameTime) {
  WorkerPool pool(2, [](int) {});
  std::atomic<int> inside = 0;
  // Ends only if three threads are in it at once.
  const auto job = [&inside](std::size_t) noexcept {
    ++inside;
    while (inside < 3) std::this_thread::yield();
  };
  pool.ForEach(3, job);
  EXPECT_EQ(inside, 3);
}

TEST(WorkerPool, EachWorker_IsPreparedWithItsNumber) {
  std::mutex mutex;
  std::set<int> numbers;
  std::set<std::thread::id> threads;
  {
    const WorkerPool pool(3, [&](int worker) {
      const std::lock_guard lock(mutex);
      numbers.insert(worker);
      threads.insert(std::this_thread::get_id());
    });
  }
  EXPECT_EQ(numbers, (std::set<int>{0, 1, 2}));
  EXPECT_EQ(threads.size(), 3U);
  EXPECT_FALSE(threads.contains(std::this_thread::get_id()));
}

}  // namespace
}  // namespace disflow::apps
