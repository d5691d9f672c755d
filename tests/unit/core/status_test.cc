// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/status.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace disflow {
namespace {

TEST(Status, Numbers_AreStable) {
  // They leave the board in telemetry: changing one breaks every receiver.
  EXPECT_EQ(static_cast<int>(Status::kOk), 0);
  EXPECT_EQ(static_cast<int>(Status::kInvalidConfig), 1);
  EXPECT_EQ(static_cast<int>(Status::kInvalidTransform), 10);
  EXPECT_EQ(static_cast<int>(Status::kNotInitialised), 16);
  EXPECT_EQ(static_cast<int>(Status::kCapacityExceeded), 19);
  EXPECT_EQ(static_cast<int>(Status::kRepeatedImage), 20);
  EXPECT_EQ(static_cast<int>(Status::kInvalidUri), 32);
  EXPECT_EQ(static_cast<int>(Status::kNotOpen), 44);
}

TEST(Status, EveryNumber_HasADescription) {
  std::set<std::string> known;
  const std::string unknown = Describe(static_cast<Status>(255));
  for (int i = 0; i < 255; ++i) {
    const char* text = Describe(static_cast<Status>(i));
    ASSERT_NE(text, nullptr) << i;
    if (text == unknown) continue;
    EXPECT_TRUE(known.insert(text).second) << i << ": " << text;
  }
  EXPECT_EQ(known.size(), 29U);
}

TEST(Expected, New_IsOk) {
  EXPECT_TRUE(Expected<int>{}.ok());
  EXPECT_FALSE((Expected<int>{0, Status::kTimeout}.ok()));
}

}  // namespace
}  // namespace disflow
