// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/memory/stage_scratch.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace disflow::testing {
namespace {

struct First {
  int count = 3;
  std::array<std::uint8_t, 100> bytes;
};
struct Second {
  double value = 0.5;
};

TEST(StageScratch, IsAsLargeAsItsLargestStage) {
  static_assert(sizeof(StageScratch<First, Second>) == sizeof(First));
  static_assert(alignof(StageScratch<First, Second>) == alignof(Second));
}

TEST(StageScratch, EveryStage_BeginsAnew) {
  StageScratch<First, Second> scratch;
  scratch.Begin<First>().count = 7;
  EXPECT_EQ(scratch.Begin<Second>().value, 0.5);
  EXPECT_EQ(scratch.Begin<First>().count, 3);
}

}  // namespace
}  // namespace disflow::testing
