// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/memory/every_nth.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

#include "disflow/memory/fixed_vector.h"

namespace disflow {
namespace {

using Numbers = FixedVector<int, 6144>;

Numbers UpTo(int size) {
  Numbers numbers;
  for (int i = 0; i < size; ++i) EXPECT_TRUE(numbers.push_back(i));
  return numbers;
}

TEST(EveryNth, EveryElement_GetsItsTurnSoon) {
  for (const int size : {1, 2, 299, 300, 301, 958, 2048, 6144}) {
    const Numbers numbers = UpTo(size);
    for (const int wanted : {1, 10, 300, 2000}) {
      if (wanted > size || size > 100 * wanted) continue;
      std::set<int> seen;
      // The golden ratio leaves no gap wider than 2.618 times the mean one.
      const int frames = 2618 * size / wanted / 1000 + 3;
      for (int frame = 0; frame < frames; ++frame) {
        const EveryNth some(numbers, wanted, static_cast<std::uint32_t>(1000 + frame));
        for (int i = 0; i < wanted; ++i) seen.insert(some[i]);
      }
      EXPECT_EQ(static_cast<int>(seen.size()), size) << wanted << " of " << size;
    }
  }
}

TEST(EveryNth, OneFrame_TakesDifferentElementsInOrderAndInRange) {
  for (const int size : {1, 7, 300, 958}) {
    const Numbers numbers = UpTo(size);
    for (const int wanted : {1, 3, 7, 300}) {
      if (wanted > size) continue;
      for (const std::uint32_t frame : {0U, 1U, 2U, 77777U, 0xFFFFFFFFU}) {
        const EveryNth some(numbers, wanted, frame);
        ASSERT_EQ(some.size(), wanted);
        int last = -1;
        for (int i = 0; i < wanted; ++i) {
          ASSERT_GT(some[i], last);
          last = some[i];
        }
        EXPECT_LT(last, size);
      }
    }
  }
}

TEST(EveryNth, WholeList_IsTakenInOrder) {
  const Numbers numbers = UpTo(958);
  for (const int wanted : {958, 2000}) {
    for (const std::uint32_t frame : {0U, 5U, 123456U}) {
      const EveryNth all(numbers, wanted, frame);
      ASSERT_EQ(all.size(), 958);
      for (int i = 0; i < 958; ++i) EXPECT_EQ(all[i], i);
    }
  }
}

}  // namespace
}  // namespace disflow
