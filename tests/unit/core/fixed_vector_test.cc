// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/memory/fixed_vector.h"

#include <gtest/gtest.h>

#include <vector>

namespace disflow {
namespace {

using Vector = FixedVector<int, 4>;
static_assert(sizeof(Vector) <= 4 * sizeof(int) + sizeof(int), "no memory beyond the elements");

Vector Filled(int count) {
  Vector vector;
  for (int i = 0; i < count; ++i) EXPECT_TRUE(vector.push_back(10 + i));
  return vector;
}

std::vector<int> Content(const Vector& vector) { return {vector.begin(), vector.end()}; }

TEST(FixedVector, New_IsEmpty) {
  const Vector vector{};
  EXPECT_TRUE(vector.empty());
  EXPECT_FALSE(vector.full());
  EXPECT_EQ(vector.size(), 0);
  EXPECT_EQ(vector.begin(), vector.end());
}

TEST(FixedVector, PushedElements_ComeBackInOrder) {
  const Vector vector = Filled(3);
  EXPECT_EQ(Content(vector), (std::vector{10, 11, 12}));
  EXPECT_EQ(vector[1], 11);
  EXPECT_FALSE(vector.full());
}

TEST(FixedVector, PushBeyondCapacity_IsRefusedAndChangesNothing) {
  Vector vector = Filled(Vector::kCapacity);
  EXPECT_TRUE(vector.full());
  EXPECT_FALSE(vector.push_back(99));
  EXPECT_EQ(Content(vector), (std::vector{10, 11, 12, 13}));
}

TEST(FixedVector, SwapRemove_MovesTheLastIntoTheGap) {
  Vector vector = Filled(4);
  vector.swap_remove(1);
  EXPECT_EQ(Content(vector), (std::vector{10, 13, 12}));
  vector.swap_remove(2);
  EXPECT_EQ(Content(vector), (std::vector{10, 13}));
}

TEST(FixedVector, SwapRemoveOfTheOnlyElement_LeavesItEmpty) {
  Vector vector = Filled(1);
  vector.swap_remove(0);
  EXPECT_TRUE(vector.empty());
}

TEST(FixedVector, Truncate_KeepsTheFirst) {
  Vector vector = Filled(4);
  vector.truncate(2);
  EXPECT_EQ(Content(vector), (std::vector{10, 11}));
  vector.truncate(2);
  EXPECT_EQ(vector.size(), 2);
  EXPECT_TRUE(vector.push_back(7));
  EXPECT_EQ(vector.back(), 7);
}

TEST(FixedVector, Cleared_TakesElementsAgain) {
  Vector vector = Filled(4);
  vector.clear();
  EXPECT_TRUE(vector.empty());
  EXPECT_TRUE(vector.push_back(5));
  EXPECT_EQ(Content(vector), (std::vector{5}));
}

TEST(FixedVector, Elements_CanBeChangedInPlace) {
  Vector vector = Filled(3);
  for (int& value : vector) value *= 2;
  vector[0] = 1;
  EXPECT_EQ(Content(vector), (std::vector{1, 22, 24}));
}

TEST(FixedVector, Copy_IsIndependent) {
  Vector vector = Filled(3);
  const Vector copy = vector;
  vector[0] = 0;
  vector.clear();
  EXPECT_EQ(Content(copy), (std::vector{10, 11, 12}));
}

}  // namespace
}  // namespace disflow
