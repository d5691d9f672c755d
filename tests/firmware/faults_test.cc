// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What goes wrong on a line and on a controller, one after the other; docs/firmware.md has the
/// table of what must come of it.

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "patched_image.h"
#include "target_run.h"

namespace disflow::firmware_test {
namespace {

using Packets = std::vector<std::vector<std::byte>>;

class FaultTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = Emulator::Missing(kM7); !missing.empty()) {
      GTEST_SKIP() << missing;
    }
    frames_ = MakeSequence("bottle", "clean", 3);
  }
  /// Two frames were tracked before, so that a third shows that tracking goes on.
  void ExpectThirdFrameIsTracked(FedBoard& board) {
    const apps::BoardAnswer answer = board.Track(frames_[2]);
    EXPECT_TRUE(answer.tracked);
    EXPECT_EQ(answer.status.status, 0);
    EXPECT_EQ(answer.odometry.reset_counter, 0);
    EXPECT_EQ(answer.odometry.time_usec,
              static_cast<std::uint64_t>(frames_[2].frame.stamp_ns / 1000));
  }

  /// The controller has restarted once since the board was started.
  void ExpectThirdFrameStartsAnew(FedBoard& board) {
    const apps::BoardAnswer answer = board.Track(frames_[2]);
    EXPECT_TRUE(answer.tracked);
    EXPECT_EQ(answer.status.status, 0);
    EXPECT_EQ(answer.timing.restarts, 1U);
    EXPECT_EQ(answer.odometry.reset_counter, 1) << "receivers must see that the object is new";
    EXPECT_EQ(answer.ready.frames, 1U);
  }

  std::vector<Frame> frames_;
};

TEST_F(FaultTest, DamagedLine_LosesThatFrameAloneAndCountsIt) {
  FedBoard board({});
  board.WaitUntilReady();
  ASSERT_TRUE(board.Track(frames_[0]).tracked);

  // Garbage in front of a frame costs nothing but its first packet, and not even that: a delimiter
  // comes first.
  std::mt19937 random(5);
  std::vector<std::byte> garbage(3000);
  for (std::byte& byte : garbage) byte = static_cast<std::byte>(random());
  Packets packets = board.connection().NextPackets(frames_[1].View());
  packets.insert(packets.begin(), garbage);
  apps::BoardAnswer answer = board.TrackPackets(packets);
  EXPECT_TRUE(answer.tracked);
  EXPECT_GT(answer.ready.packets_corrupt, 0U);
  EXPECT_EQ(answer.ready.frames_lost, 0U);

  // A byte that is lost, a byte that is flipped, a packet that is lost, the end that is lost.
  const auto broken = [&](auto&& damage) {
    Packets some = board.connection().NextPackets(frames_[2].View());
    damage(some);
    return board.TrackPackets(some);
  };
  const auto erase_byte = [](Packets& some) { some[7].erase(some[7].begin() + 9); };
  const auto flip_byte = [](Packets& some) { some[8][9] ^= std::byte{0x40}; };
  const auto erase_packet = [](Packets& some) { some.erase(some.begin() + 11); };
  const auto erase_start = [](Packets& some) { some.erase(some.begin()); };
  const auto erase_end = [](Packets& some) { some.pop_back(); };
  std::uint32_t lost = 0;
  for (const auto& damage :
       {std::function<void(Packets&)>(erase_byte), {flip_byte}, {erase_packet}, {erase_start}}) {
    answer = broken(damage);
    EXPECT_FALSE(answer.tracked);
    EXPECT_EQ(answer.ready.frames_lost, ++lost);
  }
  // Without its end a frame is not known to be lost before the next begins; the poll is answered.
  answer = broken(erase_end);
  EXPECT_FALSE(answer.tracked);
  EXPECT_EQ(answer.ready.frames_lost, lost);

  ExpectThirdFrameIsTracked(board);
}

TEST_F(FaultTest, FramesThatDoNotFit_AreRefusedAndCounted) {
  FedBoard board({});
  board.WaitUntilReady();
  ASSERT_TRUE(board.Track(frames_[0]).tracked);
  ASSERT_TRUE(board.Track(frames_[1]).tracked);

  // More pixels than there is memory for.
  Frame large = frames_[2];
  large.frame.depth.width_px = 400;
  large.frame.depth.height_px = 300;
  large.frame.depth.stride_bytes = 800;
  large.pixels.assign(400 * 300, 7000);
  apps::BoardAnswer answer = board.Track(large);
  EXPECT_FALSE(answer.tracked);
  EXPECT_EQ(answer.ready.frames_refused, 1U);

  // Few enough pixels, but wider than the profile allows: the tracker says so.
  Frame wide = frames_[2];
  wide.frame.depth.width_px = 400;
  wide.frame.depth.height_px = 30;
  wide.frame.depth.stride_bytes = 800;
  wide.pixels.assign(400 * 30, 7000);
  answer = board.Track(wide);
  EXPECT_TRUE(answer.tracked);
  EXPECT_EQ(answer.status.status, static_cast<std::uint8_t>(Status::kImageTooLarge));

  ExpectThirdFrameIsTracked(board);
}

TEST_F(FaultTest, BytesBeyondTheReceiveBuffer_AreCountedAndTrackingGoesOn) {
  FedBoard board({});
  board.WaitUntilReady();
  ASSERT_TRUE(board.Track(frames_[0]).tracked);
  // Frames follow without waiting: bytes arrive while the controller works. How many is a matter of
  // the host's pace, so this is tried until some are lost.
  apps::BoardAnswer answer;
  constexpr int kMostRounds = 100;
  board.line().set_hurried(true);
  for (int round = 0; round < kMostRounds && answer.ready.bytes_lost == 0; ++round) {
    const Packets one = board.connection().NextPackets(frames_[1].View());
    Packets hurried = one;
    for (int copy = 0; copy < 2; ++copy) hurried.insert(hurried.end(), one.begin(), one.end());
    answer = board.TrackPackets(hurried);
    board.WaitUntilReady();
    answer = board.TrackPackets(Packets{});  // polls, and so learns the counters
  }
  EXPECT_GT(answer.ready.bytes_lost, 0U);
  board.line().set_hurried(false);
  answer = board.Track(frames_[2]);
  EXPECT_TRUE(answer.tracked);
  EXPECT_EQ(answer.status.status, 0);
}

TEST_F(FaultTest, StageOverItsBudget_IsCountedAndTheFrameStands) {
  FedBoard board({});
  board.WaitUntilReady();
  FedBoard::Check(board.connection().SetBudgets({.frame_us = 0, .stage_us = 1}));
  const apps::BoardAnswer answer = board.Track(frames_[0]);
  EXPECT_EQ(answer.status.status, 0);
  EXPECT_GE(answer.timing.stages_late, 3U);
  EXPECT_EQ(answer.timing.restarts, 0U);
}

TEST_F(FaultTest, FrameOverItsBudget_RestartsTheControllerWhichTracksAnew) {
  EmulatorOptions slow;
  slow.icount_shift = 8;  // 256 ns an instruction: a frame takes seconds
  FedBoard board(slow);
  board.WaitUntilReady();
  ASSERT_TRUE(board.Track(frames_[0]).tracked);
  FedBoard::Check(board.connection().SetBudgets({.frame_us = 100'000, .stage_us = 0}));
  EXPECT_FALSE(board.Track(frames_[1]).tracked);
  // Budgets are gone with the restart.
  ExpectThirdFrameStartsAnew(board);
}

TEST_F(FaultTest, ProcessorFault_RestartsTheControllerWhichTracksAnew) {
  for (const Board& model : {kM7, kM55}) {
    if (!Emulator::Missing(model).empty()) continue;
    const PatchedImage image(model.image, "DecodeBudgets");
    EmulatorOptions patched;
    patched.board = model;
    patched.image = image.path();
    FedBoard board(patched);
    board.WaitUntilReady();
    ASSERT_TRUE(board.Track(frames_[0]).tracked) << model.name;
    ASSERT_TRUE(board.Track(frames_[1]).tracked) << model.name;
    // The answer to this is the instruction that there is not.
    (void)board.connection().SetBudgets({.frame_us = 0, .stage_us = 1});
    (void)board.connection().WaitUntilReady(kPatience_ns);
    ExpectThirdFrameStartsAnew(board);
  }
}

}  // namespace
}  // namespace disflow::firmware_test
