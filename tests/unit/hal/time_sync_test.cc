// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/time_sync.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "message_line.h"
#include "wire_samples.h"

namespace disflow::hal::mavlink {
namespace {

constexpr std::int64_t kMs_ns = 1'000'000;
constexpr std::int64_t kSecond_ns = 1000 * kMs_ns;
constexpr FrameHeader kAutopilot{.sequence = 0, .system_id = 1, .component_id = 1};

/// A message as a decoder gives it, while `bytes` lives.
FrameView FrameOf(const testing::Bytes& bytes, const FrameHeader& sender) {
  const auto size = std::to_integer<std::size_t>(bytes[1]);
  return {.header = sender,
          .message_id = TimeSyncMessage::kId,
          .payload = std::span(bytes).subspan(kHeaderSize, size)};
}

/// The own end, and an autopilot whose clock runs otherwise.
class TimeSyncTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::int64_t OtherClock(std::int64_t own_ns) const {
    return own_ns + offset_ns_ +
           static_cast<std::int64_t>(
               std::llround(rate_error_ * static_cast<double>(own_ns - kSecond_ns)));
  }
  void Deliver(const TimeSyncMessage& message, const FrameHeader& sender, std::int64_t at_ns) {
    test::MessageLine(sync_).Deliver(testing::Encoded(message, sender), at_ns);
  }
  /// A question, answered after `there_ns` and back after `back_ns` more.
  bool Exchange(std::int64_t there_ns, std::int64_t back_ns,
                const FrameHeader& sender = kAutopilot) {
    now_ns_ += TimeSync::kInterval_ns;
    TimeSyncMessage message;
    if (!sync_.Ask(now_ns_, message)) return false;
    EXPECT_EQ(message.tc1, 0);
    message.tc1 = OtherClock(now_ns_ + there_ns);
    Deliver(message, sender, now_ns_ + there_ns + back_ns);
    return true;
  }
  [[nodiscard]] ClockOffset Known() const {
    const auto offset = sync_.OffsetAt(now_ns_);
    EXPECT_TRUE(offset.ok());
    return offset.value;
  }
  /// By how much what is known is wrong.
  [[nodiscard]] std::int64_t Error() const {
    return std::abs(Known().offset_ns - (OtherClock(now_ns_) - now_ns_));
  }

  TimeSync sync_;
  std::int64_t now_ns_ = kSecond_ns;
  std::int64_t offset_ns_ = 1000 * kSecond_ns;
  double rate_error_ = 0.0;
};

TEST_F(TimeSyncTest, NoAnswer_TheOtherClockIsNotKnown) {
  TimeSyncMessage question;
  EXPECT_FALSE(sync_.OffsetAt(now_ns_).ok());
  ASSERT_TRUE(sync_.Ask(now_ns_, question));
  EXPECT_FALSE(sync_.OffsetAt(now_ns_).ok());
}

TEST_F(TimeSyncTest, Questions_AreAskedOncePerInterval) {
  TimeSyncMessage question;
  ASSERT_TRUE(sync_.Ask(now_ns_, question));
  EXPECT_EQ(question.ts1, now_ns_);
  EXPECT_FALSE(sync_.Ask(now_ns_ + TimeSync::kInterval_ns - 1, question));
  EXPECT_TRUE(sync_.Ask(now_ns_ + TimeSync::kInterval_ns, question));
}

TEST_F(TimeSyncTest, OneAnswer_BoundsTheErrorByHalfItsRoundTrip) {
  for (const std::int64_t there_ns : {0 * kMs_ns, 3 * kMs_ns, 10 * kMs_ns}) {
    sync_ = {};
    ASSERT_TRUE(Exchange(there_ns, 10 * kMs_ns - there_ns));
    EXPECT_LE(Error(), Known().uncertainty_ns) << there_ns;
    EXPECT_LE(Known().uncertainty_ns, 5 * kMs_ns + 40'000) << there_ns;
  }
}

TEST_F(TimeSyncTest, SlowAnswersAmongQuickOnes_CostNothing) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int64_t> slow_ns(0, 120 * kMs_ns);
  for (int i = 0; i < 100; ++i) {
    if (i % 8 == 0) {
      ASSERT_TRUE(Exchange(kMs_ns / 5, kMs_ns / 5));
    } else {
      ASSERT_TRUE(Exchange(slow_ns(random), slow_ns(random)));
    }
    EXPECT_LE(Error(), Known().uncertainty_ns);
    EXPECT_LE(Error(), kMs_ns / 2) << i;
  }
  EXPECT_EQ(sync_.restarts(), 0U);
}

TEST_F(TimeSyncTest, ClocksThatDrift_AreFollowedWithinTheBounds) {
  for (const double rate_error : {-9e-5, 9e-5}) {
    sync_ = {};
    rate_error_ = rate_error;
    for (int i = 0; i < 1000; ++i) {
      ASSERT_TRUE(Exchange(kMs_ns / 4, kMs_ns / 2));
      EXPECT_LE(Error(), Known().uncertainty_ns);
    }
    EXPECT_LE(Error(), kMs_ns / 2);
  }
  EXPECT_EQ(sync_.restarts(), 0U);
}

TEST_F(TimeSyncTest, OneWrongAnswer_MovesNothing) {
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(Exchange(kMs_ns, kMs_ns));
  offset_ns_ += 40 * kMs_ns;
  ASSERT_TRUE(Exchange(0, 0));
  offset_ns_ -= 40 * kMs_ns;
  EXPECT_LE(Error(), kMs_ns + 200'000);
  ASSERT_TRUE(Exchange(kMs_ns, kMs_ns));
  EXPECT_LE(Error(), kMs_ns + 200'000);
  EXPECT_EQ(sync_.restarts(), 0U);
}

TEST_F(TimeSyncTest, AutopilotThatStartsAnew_IsBelievedAfterSomeAnswers) {
  for (int i = 0; i < 40; ++i) ASSERT_TRUE(Exchange(kMs_ns, kMs_ns));
  offset_ns_ = -now_ns_ / 2;
  for (int i = 0; i < TimeSync::kAgreeing; ++i) ASSERT_TRUE(Exchange(kMs_ns, kMs_ns));
  EXPECT_LE(Error(), kMs_ns + 200'000);
  EXPECT_EQ(sync_.restarts(), 1U);
}

TEST_F(TimeSyncTest, WrongFirstAnswer_IsFoundOut) {
  offset_ns_ = 77 * kSecond_ns;
  ASSERT_TRUE(Exchange(0, 0));
  offset_ns_ = 1000 * kSecond_ns;
  for (int i = 0; i < TimeSync::kAgreeing; ++i) ASSERT_TRUE(Exchange(kMs_ns, kMs_ns));
  EXPECT_LE(Error(), kMs_ns + 200'000);
}

TEST_F(TimeSyncTest, AnswersToOthersAndLateOnes_SayNothing) {
  TimeSyncMessage message;
  ASSERT_TRUE(sync_.Ask(now_ns_, message));
  message.tc1 = OtherClock(now_ns_);
  TimeSyncMessage foreign = message;
  foreign.ts1 = now_ns_ - 1;
  Deliver(foreign, kAutopilot, now_ns_);
  Deliver(message, kAutopilot, now_ns_ + TimeSync::kMaxRoundTrip_ns + 1);
  Deliver(message, kAutopilot, now_ns_ - 1);
  Deliver(message, {.sequence = 0, .system_id = 1, .component_id = 2}, now_ns_);
  for (const std::int64_t clock_ns :
       {std::int64_t{0}, std::int64_t{-5}, std::numeric_limits<std::int64_t>::min(),
        std::numeric_limits<std::int64_t>::max()}) {
    TimeSyncMessage absurd = message;
    absurd.tc1 = clock_ns;
    Deliver(absurd, kAutopilot, now_ns_);
  }
  EXPECT_FALSE(sync_.OffsetAt(now_ns_).ok());
  Deliver(message, kAutopilot, now_ns_ + 2 * kMs_ns);
  const ClockOffset once = Known();
  // The same once more, sooner than it can have been.
  Deliver(message, kAutopilot, now_ns_);
  EXPECT_EQ(Known().uncertainty_ns, once.uncertainty_ns);
}

TEST_F(TimeSyncTest, SecondAutopilot_IsTakenOnlyWhenTheFirstIsSilent) {
  constexpr FrameHeader kOther{.sequence = 0, .system_id = 2, .component_id = 1};
  ASSERT_TRUE(Exchange(kMs_ns, kMs_ns));
  offset_ns_ += 5 * kSecond_ns;
  for (int i = 0; i < 2 * TimeSync::kAgreeing; ++i) ASSERT_TRUE(Exchange(0, 0, kOther));
  EXPECT_NEAR(static_cast<double>(Known().offset_ns), 1e12, 2e6);
  now_ns_ += TimeSync::kMaxSilence_ns;
  EXPECT_FALSE(sync_.OffsetAt(now_ns_).ok());
  ASSERT_TRUE(Exchange(0, 0, kOther));
  EXPECT_NEAR(static_cast<double>(Known().offset_ns), 1.005e12, 2e6);
}

TEST(TimeQuestion, QuestionsToUsAndToAll_AreAnsweredWithTheirOwnTime) {
  for (const int target : {0, 190, 1}) {
    TimeSyncMessage asked;
    asked.ts1 = 123'456'789'012;
    asked.target_system = static_cast<std::uint8_t>(target);
    const testing::Bytes bytes = testing::Encoded(asked, kAutopilot);
    const FrameView frame = FrameOf(bytes, kAutopilot);
    TimeSyncMessage question;
    EXPECT_EQ(IsTimeQuestion(frame, question), target != 1);
    const TimeSyncMessage answer = AnswerTo(question, frame.header, 42);
    EXPECT_EQ(answer.tc1, 42);
    EXPECT_EQ(answer.ts1, asked.ts1);
    EXPECT_EQ(answer.target_system, 1);
    EXPECT_EQ(answer.target_component, 1);
  }
}

TEST(TimeQuestion, Answers_AreNoQuestions) {
  TimeSyncMessage answer;
  answer.tc1 = 5;
  const testing::Bytes bytes = testing::Encoded(answer, kAutopilot);
  const FrameView frame = FrameOf(bytes, kAutopilot);
  TimeSyncMessage question;
  EXPECT_FALSE(IsTimeQuestion(frame, question));
}

}  // namespace
}  // namespace disflow::hal::mavlink
