// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/distance_query_input.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "message_line.h"

namespace disflow::hal::mavlink {
namespace {

// As docs/wire-format.md says; they must never change.
static_assert(PayloadSize<DisflowQuery>() == 127 && CrcExtra<DisflowQuery>() == 12);
static_assert(PayloadSize<DisflowField>() == 216 && CrcExtra<DisflowField>() == 94);

std::vector<std::byte> Encoded(const DisflowQuery& query) {
  std::vector<std::byte> bytes(kMaxFrameSize);
  const auto size = EncodeFrame(query, {.sequence = 1, .system_id = 9, .component_id = 1}, bytes);
  EXPECT_TRUE(size.ok());
  bytes.resize(size.value);
  return bytes;
}

DisflowQuery Question(std::uint32_t request, std::uint8_t count) {
  DisflowQuery query;
  query.request = request;
  query.target_system = 190;
  query.target_component = 25;
  query.count = count;
  for (std::size_t i = 0; i < DisflowQuery::kPoints; ++i) query.x[i] = static_cast<float>(i + 1);
  return query;
}

TEST(DistanceQueryInput, QuestionsInAnyPieces_WaitInOrder) {
  DistanceQueryInput input;
  test::MessageLine line(input);
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (const std::byte byte : Encoded(Question(i, 2))) line.Deliver(std::span(&byte, 1));
  }
  ASSERT_EQ(input.waiting().size(), 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(input.waiting()[i].request, static_cast<std::uint32_t>(i));
    EXPECT_EQ(input.waiting()[i].x[1], 2.0F);
  }
  EXPECT_EQ(input.refused(), 0U);
}

TEST(DistanceQueryInput, MoreThanFit_AreRefusedAndCounted) {
  DistanceQueryInput input;
  test::MessageLine line(input);
  for (std::uint32_t i = 0; i < 10; ++i) line.Deliver(Encoded(Question(i, 1)));
  EXPECT_EQ(input.waiting().size(), DistanceQueryInput::kMaxWaiting);
  EXPECT_EQ(input.refused(), 10U - DistanceQueryInput::kMaxWaiting);
  input.Clear();
  line.Deliver(Encoded(Question(77, 1)));
  ASSERT_EQ(input.waiting().size(), 1);
  EXPECT_EQ(input.waiting()[0].request, 77U);
}

TEST(DistanceQueryInput, NoPointOrTooMany_IsRefused) {
  DistanceQueryInput input;
  test::MessageLine line(input);
  for (const int count : {0, 11, 255}) {
    line.Deliver(Encoded(Question(1, static_cast<std::uint8_t>(count))));
  }
  EXPECT_EQ(input.waiting().size(), 0);
  EXPECT_EQ(input.refused(), 3U);
}

TEST(DistanceQueryInput, QuestionToAnotherSystem_IsNotOurs) {
  DistanceQueryInput input;
  test::MessageLine line(input);
  DisflowQuery query = Question(1, 1);
  query.target_system = 1;
  line.Deliver(Encoded(query));
  EXPECT_EQ(input.waiting().size(), 0);
  EXPECT_EQ(input.refused(), 0U);
}

TEST(DistanceQueryInput, AmongGarbage_EveryWholeQuestionIsFound) {
  std::mt19937 random(3);
  DistanceQueryInput input;
  test::MessageLine line(input);
  int found = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    std::vector<std::byte> garbage(random() % 300);
    for (std::byte& byte : garbage) byte = static_cast<std::byte>(random());
    // Never the start of a frame that would swallow what follows.
    std::replace(garbage.begin(), garbage.end(), std::byte{kMagic}, std::byte{0});
    line.Deliver(garbage);
    line.Deliver(Encoded(Question(i, 10)));
    found += input.waiting().size();
    input.Clear();
  }
  EXPECT_EQ(found, 200);
}

TEST(AnswerQuery, EveryPoint_GetsItsOwnAnswer) {
  const DisflowField field = AnswerQuery(Question(5, 3), 42'000, [](const Vec3& x_m) {
    Expected<DistanceQuery> answer;
    answer.value = {x_m.x(), Vec3(0.0F, x_m.x(), 0.0F), 0.5F * x_m.x(), x_m.x() > 1.5F};
    if (x_m.x() == 2.0F) answer.status = Status::kOutOfBounds;
    return answer;
  });
  EXPECT_EQ(field.time_usec, 42U);
  EXPECT_EQ(field.request, 5U);
  EXPECT_EQ(field.count, 3);
  EXPECT_EQ(field.distance[0], 1.0F);
  EXPECT_TRUE(std::isnan(field.distance[1]));
  EXPECT_EQ(field.gradient_y[2], 3.0F);
  EXPECT_EQ(field.variance[2], 1.5F);
  EXPECT_EQ(field.in_bounds, 0b100);
  EXPECT_EQ(field.status, 0);
}

TEST(AnswerQuery, WithoutAModel_SaysSo) {
  const DisflowField field = AnswerQuery(Question(5, 1), 0, [](const Vec3&) {
    Expected<DistanceQuery> answer;
    answer.status = Status::kNotInitialised;
    return answer;
  });
  EXPECT_EQ(field.status, static_cast<std::uint8_t>(Status::kNotInitialised));
  EXPECT_TRUE(std::isnan(field.distance[0]));
}

}  // namespace
}  // namespace disflow::hal::mavlink
