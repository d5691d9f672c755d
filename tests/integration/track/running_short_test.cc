// SPDX-License-Identifier: BSD-3-Clause
// Systems that fall short of something while the program runs, and programs that are stopped while
// others talk to them.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "child_process.h"
#include "disflow/hal/mavlink/frame_decoder.h"
#include "disflow/hal/mavlink/messages.h"
#include "endless_run.h"
#include "estimate_csv.h"
#include "eventually.h"
#include "loopback_port.h"
#include "memory_group.h"
#include "small_disk.h"
#ifdef DISFLOW_HAS_VIEW
#include "raw_client.h"
#endif

namespace disflow::test {
namespace {

namespace fs = std::filesystem;
namespace mavlink = hal::mavlink;

class RunningShort : public ScratchFolderTest {
 protected:
  void Start(Arguments more) {
    more.insert(more.begin(),
                {"--sensor", "sim:bottle?width=320&height=180&frames=30000", "--headless"});
    track_.emplace(DISFLOW_TRACK, more, scratch());
  }
  void Limit(__rlimit_resource resource, rlim_t most) const {
    rlimit limit{};
    ASSERT_EQ(::prlimit(track_->pid(), resource, nullptr, &limit), 0);
    limit.rlim_cur = std::min(most, limit.rlim_max);
    ASSERT_EQ(::prlimit(track_->pid(), resource, &limit, nullptr), 0);
  }
  [[nodiscard]] bool Says(const std::string& words) const {
    return Eventually([&] { return track_->said().find(words) != std::string::npos; });
  }
  /// Rows of all files run-NUMBER.csv; each has a frame's number, which goes on from file to file.
  [[nodiscard]] int RowsInOrder() const {
    int rows = 0;
    for (int i = 1; fs::exists(File(i)); ++i) {
      std::istringstream lines(ReadFile(File(i)));
      std::string line;
      std::getline(lines, line);  // names
      for (; std::getline(lines, line); ++rows)
        EXPECT_EQ(line.substr(0, line.find(',')), std::to_string(rows)) << File(i);
    }
    return rows;
  }
  [[nodiscard]] std::string File(int number) const {
    std::string digits = std::to_string(number);
    digits.insert(0, 6 - digits.size(), '0');
    return Path("run-" + digits + ".csv");
  }
  [[nodiscard]] int Files() const {
    int files = 0;
    while (fs::exists(File(files + 1))) ++files;
    return files;
  }
  Outcome Stop() {
    track_->Signal(SIGTERM);
    return track_->Wait();
  }
  void ExpectReplays(const std::string& recording) const {
    const Outcome replay =
        RunTrack({"--sensor", "replay:" + recording, "--csv", Path("again.csv")}, scratch());
    EXPECT_EQ(replay.exit_status, 0) << replay.err;
    EXPECT_GE(apps::LoadEstimates(Path("again.csv"), 30000).rows.size(), 2U);
  }

  std::optional<ChildProcess> track_;
};

TEST_F(RunningShort, OfDescriptors_TracksOnAndOpensFilesAgainWhenItMay) {
  WriteFile(Path("run.toml"), "[registration]\niterations = 8\n");
  Start({"--rate", "live", "--config", Path("run.toml"), "--csv", Path("run-{n}.csv"),
         "--rotate-age", "0.3"});
  ASSERT_TRUE(Eventually([this] { return Files() >= 2; }));
  Limit(RLIMIT_NOFILE, 3);
  track_->Signal(SIGHUP);
  EXPECT_TRUE(Says("run.toml: cannot be read: Too many open files; all settings stay"))
      << track_->said();
  EXPECT_TRUE(Says("the files are not rotated, it is tried again")) << track_->said();
  Limit(RLIMIT_NOFILE, 1024);
  const int files = Files();
  WriteFile(Path("run.toml"), "[registration]\niterations = 9\n");
  track_->Signal(SIGHUP);
  EXPECT_TRUE(Says("registration.iterations = 9 (was 8)"));
  ASSERT_TRUE(Eventually([&] { return Files() >= files + 2; })) << track_->said();
  const Outcome outcome = Stop();
  EXPECT_EQ(outcome.exit_status, 4) << "files were not rotated; " << outcome.err;
  const int rows = RowsInOrder();
  EXPECT_NE(outcome.err.find(std::to_string(rows) + " frames in"), std::string::npos)
      << outcome.err;
}

TEST_F(RunningShort, OfAddressSpace_EndsWithAWordIfAtAllAndWhatWasRecordedReplays) {
  Start({"--rate", "live", "--record", Path("rec-{n}"), "--rotate-age", "0.3"});
  AwaitLines(Path("rec-000002/data.txt"), 2);
  Limit(RLIMIT_AS, 1'000'000);
  // Files that are opened want memory, and the limit stands until one of them gets none.
  const bool is_said = Eventually([this] {
    return track_->said().find("memory") != std::string::npos || fs::exists(Path("rec-000020"));
  });
  EXPECT_TRUE(is_said) << track_->said();
  const Outcome outcome = Stop();
  EXPECT_GE(outcome.exit_status, 0) << "ended by a signal; " << outcome.err;
  if (outcome.exit_status != 0) {
    EXPECT_NE(outcome.err.find("memory"), std::string::npos) << outcome.err;
  }
  ExpectReplays(Path("rec-000001"));
}

TEST_F(RunningShort, OfAGroupsMemory_IsKilledAndWhatWasRecordedReplays) {
  const MemoryGroup group(96'000'000);
  if (!group.refusal().empty()) GTEST_SKIP() << group.refusal();
  // What is written there takes the group's memory.
  const SmallDisk disk("size=900m", scratch());
  if (!disk.refusal().empty()) GTEST_SKIP() << disk.refusal();
  ChildProcess track(
      "/bin/sh",
      {"-c", R"(echo $$ >"$0" && exec "$@")", group.processes(), DISFLOW_TRACK, "--sensor",
       "sim:bottle?frames=2000", "--headless", "--record", disk.Path("recorded")},
      scratch());
  const Outcome outcome = track.Wait();
  EXPECT_EQ(outcome.exit_status, -SIGKILL) << outcome.err;
  ExpectReplays(disk.Path("recorded"));
}

/// Reads what the program sends.
class Receiver {
 public:
  [[nodiscard]] std::uint16_t port() const { return port_.number(); }
  /// @return Whether another pose came, whose stamp is later than the one before.
  [[nodiscard]] bool TakesPose() {
    std::array<std::byte, 2048> buffer{};
    for (bool is_new = false; !is_new;) {
      const std::size_t size = port_.Receive(buffer, kPatience_ms);
      if (size == 0) return false;
      decoder_.ForEachFrame(std::span<const std::byte>(buffer).first(size), nullptr,
                            [this, &is_new](const mavlink::FrameView& frame) {
                              mavlink::Odometry odometry;
                              if (mavlink::DecodePayload(frame, odometry) != Status::kOk) return;
                              EXPECT_GT(odometry.time_usec, newest_us_);
                              newest_us_ = odometry.time_usec;
                              is_new = true;
                            });
    }
    return true;
  }
  void SendTo(std::uint16_t port, std::span<const std::byte> bytes) const {
    port_.SendTo(port, bytes);
  }

 private:
  LoopbackPort port_;
  mavlink::FrameDecoder decoder_;
  std::uint64_t newest_us_ = 0;
};

TEST_F(RunningShort, OfTimeWhileOthersTalkToIt_ServesThemAllAfterwards) {
  Receiver receiver;
  const std::uint16_t own = LoopbackPort().number();  // free again now
  Start({"--rate", "live", "--csv", Path("run-1.csv"),
#ifdef DISFLOW_HAS_VIEW
         "--view", "127.0.0.1:0?token=none",
#endif
         "--link",
         "udp://127.0.0.1:" + std::to_string(receiver.port()) + "?bind=" + std::to_string(own)});
  ASSERT_TRUE(receiver.TakesPose());
  for (int i = 0; i < 3; ++i) {
    track_->Signal(SIGSTOP);
    const std::array<std::byte, 200> noise{};
    for (int j = 0; j < 2000; ++j) receiver.SendTo(own, noise);
#ifdef DISFLOW_HAS_VIEW
    const std::string said = track_->said();
    const std::string address = "http://127.0.0.1:";
    ASSERT_NE(said.find(address), std::string::npos) << said;
    const int port = std::atoi(said.c_str() + said.find(address) + address.size());
    // Asks while nobody answers.
    RawClient viewer(port);
    viewer.Send("GET / HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n");
#endif
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    track_->Signal(SIGCONT);
    for (int j = 0; j < 10; ++j) ASSERT_TRUE(receiver.TakesPose());
#ifdef DISFLOW_HAS_VIEW
    EXPECT_EQ(StatusOf(viewer.ReadUntil("\r\n\r\n")), 200);
#endif
  }
  const Outcome outcome = Stop();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
}

}  // namespace
}  // namespace disflow::test
