// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "child_process.h"
#include "disflow/hal/mavlink/frame_decoder.h"
#include "disflow/hal/mavlink/messages.h"
#include "disflow/posix/signing_time_file.h"
#include "endless_run.h"
#include "estimate_csv.h"
#include "eventually.h"
#include "loopback_port.h"
#include "scratch_folder.h"
#include "signed_samples.h"

namespace disflow::test {
namespace {

namespace mavlink = hal::mavlink;

constexpr int kEndless = 30000;

/// Systems that are set, stopped and short of what programs need.
class AdverseSystem : public ScratchFolderTest {
 protected:
  /// Lines of the trajectory so far, its header included.
  [[nodiscard]] std::ptrdiff_t Lines() const {
    const std::string text = ReadFile(Path("run.csv"));
    return std::count(text.begin(), text.end(), '\n');
  }
  void AwaitMoreLines() const { AwaitLines(Path("run.csv"), Lines() + 10); }

  /// Each row's stamp must be later than the one before.
  void ExpectOrderedStamps() const {
    const auto rows = apps::LoadEstimates(Path("run.csv"), kEndless).rows;
    ASSERT_GT(rows.size(), 20U);
    for (std::size_t i = 1; i < rows.size(); ++i)
      ASSERT_GT(rows[i].timestamp_s, rows[i - 1].timestamp_s) << "row " << i;
  }
};

/// The clock that is set is that of the day; the monotonic one is the kernel's promise.
class ClockThatIsSet : public AdverseSystem {
 protected:
  ClockThatIsSet() {
    Set("+0");
    ::setenv("LD_PRELOAD", DISFLOW_FAKETIME, 1);
    ::setenv("FAKETIME_TIMESTAMP_FILE", Path("clock").c_str(), 1);
    ::setenv("FAKETIME_NO_CACHE", "1", 1);
    ::setenv("FAKETIME_DONT_FAKE_MONOTONIC", "1", 1);
  }
  ~ClockThatIsSet() override {
    for (const char* name : {"LD_PRELOAD", "FAKETIME_TIMESTAMP_FILE", "FAKETIME_NO_CACHE",
                             "FAKETIME_DONT_FAKE_MONOTONIC"})
      ::unsetenv(name);
  }
  /// @param offset As libfaketime wants it. The file is never seen half written.
  void Set(const std::string& offset) const {
    WriteFile(Path("clock.new"), offset + "\n");
    std::filesystem::rename(Path("clock.new"), Path("clock"));
  }
};

TEST_F(ClockThatIsSet, ForwardsAndBack_StampsOfFileAndLinkGoOnAsIfNothingHadHappened) {
  if (std::string(DISFLOW_FAKETIME).empty()) GTEST_SKIP() << "needs the package faketime";
  Set("+10y");
  const Outcome date = ChildProcess("/bin/date", {"+%s"}, scratch()).Wait();
  ASSERT_GT(std::stoll(date.out), std::time(nullptr) + 1'000'000) << "the clock is not set at all";
  Set("+0");
  LoopbackPort receiver;
  ChildProcess track(
      DISFLOW_TRACK,
      {"--sensor", kEndlessSensor, "--rate", "realtime", "--headless", "--csv", Path("run.csv"),
       "--link", "udp://127.0.0.1:" + std::to_string(receiver.number())},
      scratch());
  for (const char* offset : {"+0", "+1h", "-1d", "+10y", "+0"}) {
    Set(offset);
    AwaitMoreLines();
  }
  track.Signal(SIGTERM);
  const Outcome outcome = track.Wait();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  ExpectOrderedStamps();

  std::array<std::byte, 2048> buffer{};
  mavlink::FrameDecoder decoder;
  std::vector<std::uint64_t> stamps_us;
  while (const std::size_t size = receiver.Receive(buffer, 0)) {
    decoder.ForEachFrame(std::span<const std::byte>(buffer).first(size), nullptr,
                         [&stamps_us](const mavlink::FrameView& frame) {
                           mavlink::Odometry odometry;
                           if (mavlink::DecodePayload(frame, odometry) == Status::kOk)
                             stamps_us.push_back(odometry.time_usec);
                         });
  }
  ASSERT_GT(stamps_us.size(), 20U);
  for (std::size_t i = 1; i < stamps_us.size(); ++i) ASSERT_GT(stamps_us[i], stamps_us[i - 1]);
}

TEST_F(ClockThatIsSet, ForwardsAndBack_SignedMessagesAreTakenByBothEnds) {
  if (std::string(DISFLOW_FAKETIME).empty()) GTEST_SKIP() << "needs the package faketime";
  constexpr std::uint8_t kCarrier = 7;
  const mavlink::SigningKey key = mavlink::testing::KeyNumber(1);
  WriteFile(Path("a.key"), {reinterpret_cast<const char*>(key.data()), key.size()});
  std::filesystem::permissions(Path("a.key"), std::filesystem::perms::owner_read);
  LoopbackPort peer;
  const std::uint16_t own = LoopbackPort().number();  // free again now
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", kEndlessSensor, "--rate", "realtime", "--headless", "--csv",
                      Path("run.csv"), "--camera-pose", std::to_string(kCarrier), "--link",
                      "udp://127.0.0.1:" + std::to_string(peer.number()) +
                          "?bind=" + std::to_string(own) + "&key=" + Path("a.key")},
                     scratch());
  mavlink::FrameDecoder decoder;
  mavlink::SigningSession session(key, posix::SigningTimeNow());
  mavlink::Odometry pose;
  pose.q = {1.0F, 0.0F, 0.0F, 0.0F};
  pose.frame_id = static_cast<std::uint8_t>(mavlink::MavFrame::kLocalFrd);
  std::size_t poses = 0;
  for (const char* offset : {"+0", "+1h", "-1d", "+10y", "+0"}) {
    Set(offset);
    AwaitMoreLines();
    mavlink::testing::Bytes buffer(2048);
    std::size_t accepted = 0;
    while (const std::size_t size = peer.Receive(buffer, 0))
      accepted += mavlink::testing::Accepted(decoder, session, std::span(buffer).first(size));
    EXPECT_GE(accepted, 10U) << offset;
    pose.time_usec += 1000;
    const auto message =
        mavlink::testing::Encoded(pose, {.sequence = 0, .system_id = kCarrier, .component_id = 1});
    peer.SendTo(own, mavlink::testing::Signed(session, posix::SigningTimeNow(), message));
    ++poses;
    AwaitMoreLines();
  }
  track.Signal(SIGTERM);
  const Outcome outcome = track.Wait();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  const hal::mavlink::DecoderCounters& counters = decoder.counters();
  EXPECT_EQ(counters.wrong_signature + counters.replayed + counters.outdated, 0U);
  EXPECT_EQ(outcome.err.find("more than a minute old"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("camera poses: " + std::to_string(poses) + " received"),
            std::string::npos)
      << outcome.err;
}

/// Of frame i when the camera's clock is set forwards, back and forwards again by an hour.
double SetStamp_s(int frame) {
  constexpr int kFrames = 30;
  return 1.0 + frame / 30.0 + (frame / kFrames % 2 == 1 ? 3600.0 : 0.0);
}

TEST_F(AdverseSystem, CameraClockThatIsSet_CostsTheFramesBehindAndNoObject) {
  constexpr int kFrames = 120;
  const Arguments sequence = {"--object", "bottle", "--frames", std::to_string(kFrames),
                              Path("seq")};
  ASSERT_EQ(RunSim(sequence, scratch()).exit_status, 0);
  const auto run = [this](const char* csv) {
    return RunTrack({"--sensor", "replay:" + Path("seq"), "--headless", "--csv", Path(csv)},
                    scratch());
  };
  ASSERT_EQ(run("steady.csv").exit_status, 0);
  std::string stamps;
  for (int i = 0; i < kFrames; ++i)
    stamps += std::to_string(i) + " " + std::to_string(SetStamp_s(i)) + "\n";
  WriteFile(Path("seq/data.txt"), stamps);
  const Outcome outcome = run("set.csv");
  EXPECT_NE(outcome.err.find("30 stamp_not_increasing"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(" 0 restarts"), std::string::npos) << outcome.err;

  const auto steady = apps::LoadEstimates(Path("steady.csv"), kFrames).rows;
  const auto set = apps::LoadEstimates(Path("set.csv"), kFrames).rows;
  ASSERT_EQ(set.size(), steady.size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    SCOPED_TRACE(set[i].frame);
    // From 60 to 89 the clock is an hour behind.
    EXPECT_EQ(set[i].status == "stamp_not_increasing", set[i].frame >= 60 && set[i].frame < 90);
    if (!set[i].has_motion) continue;
    EXPECT_LT(set[i].twist.linear_mps.norm(), 2.0 * steady[i].twist.linear_mps.norm() + 0.3);
    EXPECT_LT(set[i].twist.angular_rps.norm(), 2.0 * steady[i].twist.angular_rps.norm() + 1.0);
  }
  EXPECT_EQ(set.back().status, "ok");
  EXPECT_EQ(set.back().state, "tracking");
}

TEST_F(AdverseSystem, StoppedAndContinued_TracksOn) {
  ChildProcess track(
      DISFLOW_TRACK,
      {"--sensor", kEndlessSensor, "--rate", "live", "--headless", "--csv", Path("run.csv")},
      scratch());
  AwaitMoreLines();
  for (int i = 0; i < 3; ++i) {
    track.Signal(SIGSTOP);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    track.Signal(SIGCONT);
    AwaitMoreLines();
  }
  ASSERT_TRUE(Eventually([this] {
    const std::string text = ReadFile(Path("run.csv"));
    const std::size_t last = text.rfind("\n", text.size() - 2);
    return text.find(",tracking,", last) != std::string::npos;
  }));
  track.Signal(SIGTERM);
  const Outcome outcome = track.Wait();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  ExpectOrderedStamps();
}

/// What a program may do that gets too little: its work, or say what it lacks.
class TooLittle : public AdverseSystem {
 protected:
  [[nodiscard]] Outcome RunWith(const std::string& limit, Arguments arguments) const {
    Arguments command = {"-c", "ulimit " + limit + R"(; exec "$0" "$@")", DISFLOW_TRACK, "--sensor",
                         "sim:bottle?frames=4"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return ChildProcess("/bin/sh", command, scratch()).Wait();
  }
  /// @return false if it did its work.
  static bool ExpectWordsIfItFails(const Outcome& outcome, const std::string& words) {
    EXPECT_GE(outcome.exit_status, 0) << "ended by a signal; " << outcome.err;
    if (outcome.exit_status == 0) return false;
    EXPECT_TRUE(outcome.exit_status == 3 || outcome.exit_status == 4) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    return true;
  }
};

TEST_F(TooLittle, Descriptors_EndWithAWordAndKeepWhatWasThere) {
  int failed = 0;
  // With fewer than six the loader itself opens no library.
  for (const int files : {6, 7, 8, 9, 10, 12, 16, 24}) {
    SCOPED_TRACE(files);
    const std::string number = std::to_string(files);
    WriteFile(Path("run.ply"), "earlier\n");
    const Outcome outcome =
        RunWith("-n " + number,
                {"--csv", Path("run.csv"), "--mesh", Path("run.ply"), "--record", Path(number),
                 "--flow", Path("flow" + number), "--link", "udp://127.0.0.1:9"});
    if (ExpectWordsIfItFails(outcome, "Too many open files")) ++failed;
    EXPECT_NE(ReadFile(Path("run.ply")), "") << "either the earlier or the new one";
  }
  EXPECT_GT(failed, 0) << "or nothing was limited";
}

TEST_F(TooLittle, AddressSpace_EndsWithAWordAndAStatus) {
  int failed = 0;
  for (const int megabytes : {55, 60, 65, 70, 80, 100, 120, 160, 200, 300}) {
    SCOPED_TRACE(megabytes);
    const Outcome outcome = RunWith(
        "-v " + std::to_string(1000 * megabytes),
        {"--rate", "live", "--csv", Path("run.csv"), "--mesh", Path("run.ply"), "--headless"});
    if (ExpectWordsIfItFails(outcome, "memory")) ++failed;
  }
  EXPECT_GT(failed, 0) << "or nothing was limited";
}

#ifdef DISFLOW_HAS_VIEW
TEST_F(TooLittle, DescriptorsForTheLiveView_AreRefusedWithTheNumberThatIsNeeded) {
  const Outcome few = RunWith("-n 20", {"--view", ":0?token=none"});
  EXPECT_EQ(few.exit_status, 4) << few.err;
  EXPECT_NE(few.err.find("only 20 files may be open at once, 72 are needed"), std::string::npos)
      << few.err;
  const Outcome enough = RunWith("-n 72", {"--view", ":0?token=none"});
  EXPECT_EQ(enough.exit_status, 0) << enough.err;
}
#endif

#ifdef DISFLOW_HAS_DDS
TEST_F(TooLittle, AddressSpaceForDds_EndsWithAWordAndAStatus) {
  int failed = 0;
  for (const int megabytes : {70, 100, 150, 200, 250, 300}) {
    SCOPED_TRACE(megabytes);
    const Outcome outcome = RunWith("-v " + std::to_string(1000 * megabytes),
                                    {"--link", "dds:domain=218&interface=lo", "--headless"});
    if (ExpectWordsIfItFails(outcome, "ulimit -v")) ++failed;
  }
  EXPECT_GT(failed, 0) << "or nothing was limited";
}
#endif

}  // namespace
}  // namespace disflow::test
