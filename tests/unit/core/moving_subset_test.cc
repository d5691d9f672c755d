// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/moving_subset.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

namespace disflow {
namespace {

TEST(MovingSubset, EveryElement_GetsItsTurnSoon) {
  for (const int size : {1, 2, 299, 300, 301, 958, 2048, 6144}) {
    for (const int wanted : {1, 10, 300, 2000}) {
      if (wanted > size || size > 100 * wanted) continue;
      std::set<int> seen;
      // The golden ratio leaves no gap wider than 2.618 times the mean one.
      const int frames = 2618 * size / wanted / 1000 + 3;
      for (int frame = 0; frame < frames; ++frame) {
        const MovingSubset subset(size, wanted, static_cast<std::uint32_t>(1000 + frame));
        for (int i = 0; i < wanted; ++i) seen.insert(subset.At(i));
      }
      EXPECT_EQ(static_cast<int>(seen.size()), size) << wanted << " of " << size;
    }
  }
}

TEST(MovingSubset, OneFrame_TakesDifferentElementsInOrderAndInRange) {
  for (const int size : {1, 7, 300, 958}) {
    for (const int wanted : {1, 3, 7, 300}) {
      if (wanted > size) continue;
      for (const std::uint32_t frame : {0U, 1U, 2U, 77777U, 0xFFFFFFFFU}) {
        const MovingSubset subset(size, wanted, frame);
        int last = -1;
        for (int i = 0; i < wanted; ++i) {
          ASSERT_GT(subset.At(i), last);
          last = subset.At(i);
        }
        EXPECT_LT(last, size);
      }
    }
  }
}

TEST(MovingSubset, WholeList_IsTakenInOrder) {
  for (const std::uint32_t frame : {0U, 5U, 123456U}) {
    const MovingSubset all(958, 958, frame);
    for (int i = 0; i < 958; ++i) EXPECT_EQ(all.At(i), i);
  }
}

}  // namespace
}  // namespace disflow
