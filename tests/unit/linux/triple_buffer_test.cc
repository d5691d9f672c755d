// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/triple_buffer.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace disflow::posix {
namespace {

constexpr std::uint64_t kHandovers = 2'000'000;

/// A value that shows it if parts of two are mixed.
struct Wide {
  std::array<std::uint64_t, 16> words{};

  void Set(std::uint64_t number) noexcept {
    for (std::uint64_t& word : words) word = number;
  }
  [[nodiscard]] bool IsWhole() const noexcept {
    for (const std::uint64_t word : words) {
      if (word != words[0]) return false;
    }
    return true;
  }
};

TEST(TripleBuffer, NothingPublished_GivesNothing) {
  TripleBuffer<int> buffer;
  EXPECT_FALSE(buffer.HasNews());
  EXPECT_FALSE(buffer.Take());
}

TEST(TripleBuffer, ValueTaken_IsGivenOnceAndStaysUntilTheNext) {
  TripleBuffer<int> buffer;
  buffer.back() = 7;
  EXPECT_FALSE(buffer.Publish());
  EXPECT_TRUE(buffer.HasNews());
  ASSERT_TRUE(buffer.Take());
  EXPECT_EQ(buffer.front(), 7);
  EXPECT_FALSE(buffer.HasNews());
  buffer.back() = 8;  // not published
  EXPECT_FALSE(buffer.Take());
  EXPECT_EQ(buffer.front(), 7);
}

TEST(TripleBuffer, ValueNotTaken_IsReplacedAndReturnedToTheWriter) {
  TripleBuffer<int> buffer;
  buffer.back() = 1;
  EXPECT_FALSE(buffer.Publish());
  buffer.back() = 2;
  EXPECT_TRUE(buffer.Publish());
  EXPECT_EQ(buffer.back(), 1);
  ASSERT_TRUE(buffer.Take());
  EXPECT_EQ(buffer.front(), 2);
  EXPECT_FALSE(buffer.Take());
}

TEST(TripleBuffer, AnyOrderOfCalls_SidesNeverShareABuffer) {
  TripleBuffer<int> buffer;
  // Every sequence of eight calls.
  for (unsigned calls = 0; calls < 256; ++calls) {
    for (unsigned i = 0; i < 8; ++i) {
      if ((calls >> i & 1U) != 0) {
        (void)buffer.Publish();
      } else {
        (void)buffer.Take();
      }
      ASSERT_NE(&buffer.back(), &buffer.front());
    }
  }
}

TEST(TripleBufferStress, FastWriter_ValuesAreWholeInOrderAndTheLastArrives) {
  TripleBuffer<Wide> buffer;
  std::uint64_t replaced = 0;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kHandovers; ++i) {
      buffer.back().Set(i);
      if (buffer.Publish()) ++replaced;
    }
  });
  std::uint64_t taken = 0;
  std::uint64_t newest = 0;
  std::uint64_t torn = 0;
  std::uint64_t not_newer = 0;
  while (newest < kHandovers) {
    if (!buffer.Take()) {
      std::this_thread::yield();
      continue;
    }
    ++taken;
    if (!buffer.front().IsWhole()) ++torn;
    if (buffer.front().words[0] <= newest) ++not_newer;
    newest = buffer.front().words[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(not_newer, 0U);
  EXPECT_FALSE(buffer.Take());
  // Each value was either taken or replaced, once.
  EXPECT_EQ(taken + replaced, kHandovers);
}

TEST(TripleBufferStress, WriterThatWaitsForTheReader_LosesNothing) {
  constexpr int kValues = 1'000;
  TripleBuffer<Wide> buffer;
  // Both sleep for each other, since a busy machine seldom gives a turn to who only yields.
  std::atomic<int> published = 0;
  std::atomic<int> taken = 0;
  int replaced = 0;
  std::thread writer([&] {
    for (int i = 1; i <= kValues; ++i) {
      buffer.back().Set(static_cast<std::uint64_t>(i));
      if (buffer.Publish()) ++replaced;
      published = i;
      published.notify_one();
      taken.wait(i - 1);
    }
  });
  int wrong = 0;
  for (int i = 1; i <= kValues; ++i) {
    published.wait(i - 1);
    const bool is_right = buffer.Take() && buffer.front().IsWhole() &&
                          buffer.front().words[0] == static_cast<std::uint64_t>(i);
    if (!is_right) ++wrong;
    taken = i;
    taken.notify_one();
  }
  writer.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(replaced, 0);
}

TEST(TripleBufferStress, ManyPairsAtOnce_DoNotDisturbEachOther) {
  constexpr std::size_t kPairs = 4;
  constexpr std::uint64_t kValues = kHandovers / kPairs;
  std::array<TripleBuffer<Wide>, kPairs> buffers;
  std::array<std::uint64_t, kPairs> wrong{};
  std::vector<std::thread> threads;
  for (std::size_t pair = 0; pair < kPairs; ++pair) {
    threads.emplace_back([&buffer = buffers[pair], pair] {
      for (std::uint64_t i = 1; i <= kValues; ++i) {
        buffer.back().Set(i * std::uint64_t{kPairs} + pair);
        (void)buffer.Publish();
      }
    });
    threads.emplace_back([&buffer = buffers[pair], &faults = wrong[pair], pair] {
      std::uint64_t newest = 0;
      while (newest < kValues) {
        if (!buffer.Take()) {
          std::this_thread::yield();
          continue;
        }
        const std::uint64_t number = buffer.front().words[0];
        if (!buffer.front().IsWhole() || number % kPairs != pair || number / kPairs <= newest) {
          ++faults;
        }
        newest = number / kPairs;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::uint64_t faults : wrong) EXPECT_EQ(faults, 0U);
}

}  // namespace
}  // namespace disflow::posix
