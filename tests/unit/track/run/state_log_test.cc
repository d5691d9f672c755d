// SPDX-License-Identifier: BSD-3-Clause
#include "run/state_log.h"

#include <gtest/gtest.h>

#include <array>

#include "journal_reader.h"
#include "named_datagrams.h"

namespace disflow::apps {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

FrameResult In(TrackingState state, std::int64_t frame = 0) {
  FrameResult result;
  result.frame = frame;
  result.estimate.state = state;
  result.estimate.quality = 42;
  return result;
}

class StateLogTest : public testing::Test {
 protected:
  StateLogTest()
      : name_("@disflow-state-" + std::to_string(::getpid())),
        journal_(name_),
        console_(false, "journald:" + name_) {}

  /// The entries since the last call.
  std::vector<std::map<std::string, std::string>> Said() {
    std::vector<std::map<std::string, std::string>> said;
    for (const std::string& datagram : journal_.Received()) {
      const auto fields = test::ReadJournalEntry(datagram);
      EXPECT_TRUE(fields.has_value());
      if (fields) said.push_back(*fields);
    }
    return said;
  }

  std::string name_;
  test::NamedDatagrams journal_;
  Console console_;
};

TEST_F(StateLogTest, ChangeOfState_IsAnEntryWithFields) {
  StateLog log({"box", "can"});
  std::array results{In(TrackingState::kInitialising), In(TrackingState::kInitialising)};
  log.Turn(results, kSecond_ns, console_);
  EXPECT_TRUE(Said().empty());
  results[1] = In(TrackingState::kLost, 7);
  results[1].estimate.status = Status::kEmptyMask;
  results[1].estimate.reset_counter = 3;
  log.Turn(results, kSecond_ns, console_);
  log.Turn(results, kSecond_ns, console_);
  const auto said = Said();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].at("MESSAGE"), "can: lost (was initialising), quality 42");
  EXPECT_EQ(said[0].at("PRIORITY"), "4");
  EXPECT_EQ(said[0].at("SYSLOG_IDENTIFIER"), "disflow_track");
  EXPECT_EQ(said[0].at("MESSAGE_ID").size(), 32U);
  EXPECT_EQ(said[0].at("DISFLOW_OBJECT"), "can");
  EXPECT_EQ(said[0].at("DISFLOW_STATE"), "lost");
  EXPECT_EQ(said[0].at("DISFLOW_STATE_BEFORE"), "initialising");
  EXPECT_EQ(said[0].at("DISFLOW_STATE_CHANGES"), "1");
  EXPECT_EQ(said[0].at("DISFLOW_STATUS"), "empty_mask");
  EXPECT_EQ(said[0].at("DISFLOW_QUALITY"), "42");
  EXPECT_EQ(said[0].at("DISFLOW_FRAME"), "7");
  EXPECT_EQ(said[0].at("DISFLOW_RESET_COUNTER"), "3");
}

TEST_F(StateLogTest, StateThatFlutters_IsToldOnceASecondWithItsChanges) {
  StateLog log({"box"});
  std::size_t entries = 0;
  int changes = 0;
  for (int frame = 1; frame <= 300; ++frame) {
    const std::array results{
        In(frame % 2 == 0 ? TrackingState::kTracking : TrackingState::kDegraded, frame)};
    log.Turn(results, frame * kSecond_ns / 30, console_);
    for (const auto& entry : Said()) {
      ++entries;
      changes += std::stoi(entry.at("DISFLOW_STATE_CHANGES"));
    }
  }
  EXPECT_LE(entries, 11U);
  EXPECT_GE(entries, 9U);
  EXPECT_GE(changes, 270);
}

TEST_F(StateLogTest, LinesForPeople_DoNotHaveIt) {
  Console text(false);
  StateLog log({"box"});
  testing::internal::CaptureStderr();
  const std::array results{In(TrackingState::kLost)};
  log.Turn(results, kSecond_ns, text);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace disflow::apps
