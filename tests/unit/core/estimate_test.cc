// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/estimate.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <set>
#include <string>

namespace disflow {
namespace {

constexpr std::uint32_t kMax = std::numeric_limits<std::uint32_t>::max();
using Raw = std::array<std::uint32_t, static_cast<std::size_t>(Counters::kCount)>;

Raw Sum(const Raw& a, const Raw& b) {
  auto total = std::bit_cast<Counters>(a);
  total.Accumulate(std::bit_cast<Counters>(b));
  return std::bit_cast<Raw>(total);
}

TEST(Counters, New_AreZero) { EXPECT_EQ(std::bit_cast<Raw>(Counters{}), Raw{}); }

TEST(Counters, EveryCounter_IsAddedToItselfAlone) {
  for (std::size_t i = 0; i < Raw{}.size(); ++i) {
    Raw start{};
    start.fill(1000);
    Raw more{};
    more[i] = 7;
    Raw expected = start;
    expected[i] = 1007;
    EXPECT_EQ(Sum(start, more), expected) << "counter " << i;
  }
}

TEST(Counters, EveryCounter_StopsAtItsMaximum) {
  for (std::size_t i = 0; i < Raw{}.size(); ++i) {
    Raw start{};
    start[i] = kMax - 3;
    Raw more{};
    more[i] = 3;
    EXPECT_EQ(Sum(start, more)[i], kMax) << "just reached, counter " << i;
    more[i] = 4;
    EXPECT_EQ(Sum(start, more)[i], kMax) << "one beyond, counter " << i;
    more[i] = kMax;
    EXPECT_EQ(Sum(start, more)[i], kMax) << "far beyond, counter " << i;
  }
}

TEST(TrackingState, EveryState_HasItsOwnName) {
  std::set<std::string> names{"unknown"};
  for (const TrackingState state :
       {TrackingState::kInitialising, TrackingState::kTracking, TrackingState::kDegraded,
        TrackingState::kLost, TrackingState::kRecovered}) {
    EXPECT_TRUE(names.insert(Name(state)).second) << Name(state);
  }
}

TEST(Stage, EveryStage_HasItsOwnName) {
  std::set<std::string> names{"unknown"};
  for (int i = 0; i < kStageCount; ++i) {
    EXPECT_TRUE(names.insert(Name(static_cast<Stage>(i))).second) << i;
  }
  EXPECT_STREQ(Name(static_cast<Stage>(kStageCount)), "unknown");
}

TEST(Estimate, New_ClaimsNothing) {
  const Estimate estimate;
  EXPECT_EQ(estimate.status, Status::kNotInitialised);
  EXPECT_EQ(estimate.quality, 0);
  EXPECT_FALSE(estimate.has_T_wo);
}

}  // namespace
}  // namespace disflow
