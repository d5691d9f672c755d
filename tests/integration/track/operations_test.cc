// SPDX-License-Identifier: BSD-3-Clause
// What whoever runs disflow_track as a service asks of it while it runs: other settings, a log that
// programs read.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <optional>
#include <set>

#include "child_process.h"
#include "endless_run.h"
#include "eventually.h"
#include "journal_reader.h"
#include "named_datagrams.h"

namespace disflow::test {
namespace {

/// What makes a tracked object degraded whatever happens.
constexpr const char* kSuspicious = "[monitor]\ndegraded_std_m = 0.0\n";

class SettingsAtRunTime : public ScratchFolderTest {
 protected:
  SettingsAtRunTime() {
    WriteFile(Path("run.toml"), "[registration]\niterations = 8\n");
    track_.emplace(DISFLOW_TRACK,
                   Arguments{"--sensor", "sim:box?noise=white&frames=30000", "--rate", "live",
                             "--config", Path("run.toml"), "--csv", Path("run.csv")},
                   scratch());
    AwaitLines(Path("run.csv"), 10);
  }

  void Reread(std::string_view file) {
    WriteFile(Path("new.toml"), file);
    std::filesystem::rename(Path("new.toml"), Path("run.toml"));
    track_->Signal(SIGHUP);
  }
  [[nodiscard]] bool Says(const std::string& words) const {
    return Eventually([&] { return track_->said().find(words) != std::string::npos; });
  }
  [[nodiscard]] std::size_t RowsWith(const std::string& word) const {
    const std::string text = ReadFile(Path("run.csv"));
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
      ++count;
    return count;
  }
  Outcome Stop() {
    track_->Signal(SIGTERM);
    return track_->Wait();
  }

  std::optional<ChildProcess> track_;
};

TEST_F(SettingsAtRunTime, HangUp_ReadsTheFileAgainAndTheNextFramesFollowIt) {
  Reread(std::string("[registration]\niterations = 9\n") + kSuspicious);
  EXPECT_TRUE(Says("registration.iterations = 9 (was 8)"));
  EXPECT_TRUE(Eventually([this] { return RowsWith(",ok,degraded,") > 0; }));
  Reread("[monitor]\ndegraded_std_m = 1.0\n");
  EXPECT_TRUE(Says("monitor.degraded_std_m = 1 (was 0)"));
  const Outcome outcome = Stop();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  // The object is the same all the time.
  EXPECT_NE(outcome.err.find(" 0 restarts"), std::string::npos) << outcome.err;
}

TEST_F(SettingsAtRunTime, FileThatIsWrong_ChangesNothingAndSaysWhy) {
  Reread(std::string(kSuspicious) + "[registration]\niterations = 99\n");
  EXPECT_TRUE(Says("run.toml:4: registration.iterations = 99 is out of range"));
  EXPECT_TRUE(Says("all settings stay as they are"));
  Reread(std::string(kSuspicious) + "[registration]\niterations = 1");
  EXPECT_TRUE(Says("does not end with a line break"));
  std::filesystem::remove(Path("run.toml"));
  track_->Signal(SIGHUP);
  EXPECT_TRUE(Says("cannot be read"));
  const Outcome outcome = Stop();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(RowsWith(",ok,degraded,"), 0U);
}

TEST_F(SettingsAtRunTime, WhatHoldsOnlyFromTheNextStartOn_IsNamed) {
  Reread("[run]\nlink = \"udp://127.0.0.1:9\"\n[field]\ncell_size_m = 0.05\n");
  EXPECT_TRUE(Says("only by a new start: --link, field.cell_size_m"));
  EXPECT_EQ(Stop().exit_status, 0);
}

TEST_F(SettingsAtRunTime, StormOfSignals_IsSurvived) {
  for (int i = 0; i < 5000; ++i) track_->Signal(SIGHUP);
  Reread(std::string("[registration]\niterations = 9\n") + kSuspicious);
  EXPECT_TRUE(Says("registration.iterations = 9 (was 8)"));
  for (int i = 0; i < 5000; ++i) track_->Signal(SIGHUP);
  const Outcome outcome = Stop();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
}

class JournalLog : public ScratchFolderTest {};

TEST_F(JournalLog, EveryMessage_IsAnEntryWithSeverityAndStatesHaveFields) {
  const NamedDatagrams journal(Path("journal"));
  const Outcome outcome = RunTrack({"--sensor", "sim:box?noise=white&frames=40", "--log",
                                    "journald:" + Path("journal"), "--cpu", "1000"},
                                   scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  std::set<std::string> states;
  std::set<std::string> severities;
  std::string messages;
  for (const std::string& datagram : journal.Received()) {
    const auto fields = ReadJournalEntry(datagram);
    ASSERT_TRUE(fields.has_value()) << datagram;
    EXPECT_EQ(fields->at("SYSLOG_IDENTIFIER"), "disflow_track");
    severities.insert(fields->at("PRIORITY"));
    messages += fields->at("MESSAGE") + "\n";
    if (fields->contains("DISFLOW_STATE")) states.insert(fields->at("DISFLOW_STATE"));
  }
  EXPECT_NE(messages.find("40 frames"), std::string::npos) << messages;
  EXPECT_TRUE(severities.contains("4")) << messages;  // that there is no such processor
  EXPECT_TRUE(states.contains("tracking"));
}

TEST_F(JournalLog, JournalThatIsNotThere_LeavesTheMessagesOnStandardError) {
  const Outcome outcome =
      RunTrack({"--sensor", "sim:box?frames=5", "--log", "journald:" + Path("nobody")}, scratch());
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("disflow_track: 5 frames"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("PRIORITY"), std::string::npos) << outcome.err;
}

TEST_F(JournalLog, WordThatIsNone_IsRefusedWithThoseThereAre) {
  for (const char* log : {"journal", "", "journald:", "journald:relative"}) {
    const Outcome outcome =
        RunTrack({"--sensor", "sim:box?frames=5", std::string("--log=") + log}, scratch());
    EXPECT_EQ(outcome.exit_status, 2) << log;
    EXPECT_NE(outcome.err.find("journald"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace disflow::test
