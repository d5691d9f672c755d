// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The firmware under an emulator against the host's build of the same tracker.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "target_run.h"

namespace disflow::firmware_test {
namespace {

constexpr std::size_t kCompared = 100;
constexpr int kWhole = 300;
constexpr float kSamePosition_m = 1e-4F;
constexpr float kSameRotation_rad = 0.05F * 3.14159265F / 180.0F;

struct Difference {
  float position_m = 0.0F;
  float rotation_rad = 0.0F;
};

Difference Largest(const std::vector<apps::BoardAnswer>& answers,
                   const std::vector<PoseCameraFromObject>& host) {
  Difference largest;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const PoseCameraFromObject target = apps::PoseOf(answers[i].odometry);
    const PoseCameraFromObject& expected = host.at(i);
    const Vec3 off = TurnBetween(expected.rotation(), target.rotation());
    largest.position_m =
        std::max(largest.position_m, (target.translation() - expected.translation()).norm());
    largest.rotation_rad = std::max(largest.rotation_rad, off.norm());
  }
  return largest;
}

struct Case {
  const char* object;
  const char* noise;

  friend void PrintTo(const Case& sequence, std::ostream* stream) {
    *stream << sequence.object << ' ' << sequence.noise;
  }
};

class SequenceTest : public ::testing::TestWithParam<Case> {};

double TrackedAddAuc(const Case& what, const std::vector<Frame>& frames,
                     const std::string& program) {
  const auto model =
      std::string(what.object) == "box" ? host::MakeCrackerBox() : host::MakeMustardBottle();
  return AddAuc(frames, TrackOnHost(frames, program), model);
}

TEST_P(SequenceTest, MicroProfile_TracksWithAddAucOf95OrMore) {
  const auto [object, noise] = GetParam();
  const std::vector<Frame> frames = MakeSequence(object, noise, kWhole);
  ASSERT_EQ(frames.size(), std::size_t{kWhole});
  const double auc = TrackedAddAuc(GetParam(), frames, DISFLOW_HOST_REFERENCE);
  std::printf("%s %s, Micro: ADD-AUC %.2f\n", object, noise, auc);
  EXPECT_GE(auc, 95.0);
}

TEST_P(SequenceTest, SmallProfile_TracksWithAddAucOf95OrMore) {
  const auto [object, noise] = GetParam();
  const std::vector<Frame> frames = MakeSequence(
      object, noise, kWhole, firmware::Small::kMaxImageWidth, firmware::Small::kMaxImageHeight);
  const double auc =
      TrackedAddAuc(GetParam(), frames, std::string(DISFLOW_HOST_REFERENCE) + "_small");
  std::printf("%s %s, Small: ADD-AUC %.2f\n", object, noise, auc);
  EXPECT_GE(auc, 95.0);
}

TEST_P(SequenceTest, CortexM7_ComputesTheHostsPoses) {
  if (const std::string missing = Emulator::Missing(kM7); !missing.empty()) {
    GTEST_SKIP() << missing;
  }
  const auto [object, noise] = GetParam();
  const std::vector<Frame> frames = MakeSequence(object, noise, kCompared);
  const auto answers = RunRecorded({}, frames, kCompared);
  for (const apps::BoardAnswer& answer : answers) ASSERT_EQ(answer.status.status, 0);
  const Difference largest = Largest(answers, TrackOnHost(frames));
  std::printf("%s %s, Cortex-M7 against host: %.2g m, %.2g rad\n", object, noise,
              static_cast<double>(largest.position_m), static_cast<double>(largest.rotation_rad));
  EXPECT_LE(largest.position_m, kSamePosition_m);
  EXPECT_LE(largest.rotation_rad, kSameRotation_rad);
}

INSTANTIATE_TEST_SUITE_P(Fast, SequenceTest,
                         ::testing::Values(Case{"box", "clean"}, Case{"box", "white"},
                                           Case{"bottle", "clean"}, Case{"bottle", "white"}),
                         [](const auto& instance) {
                           return std::string(instance.param.object) + "_" + instance.param.noise;
                         });

class BoardTest : public ::testing::TestWithParam<Board> {
 protected:
  void SetUp() override {
    if (const std::string missing = Emulator::Missing(GetParam()); !missing.empty()) {
      GTEST_SKIP() << missing;
    }
  }
};

TEST_P(BoardTest, FramesOverTheUart_ComeBackAsTheHostsPoses) {
  const std::vector<Frame> frames = MakeSequence("bottle", "clean", 4);
  const std::vector<PoseCameraFromObject> host = TrackOnHost(frames);
  FedBoard board({.board = GetParam()});
  board.WaitUntilReady();
  std::vector<apps::BoardAnswer> answers;
  for (const Frame& frame : frames) answers.push_back(board.Track(frame));
  const Difference largest = Largest(answers, host);
  EXPECT_LE(largest.position_m, kSamePosition_m);
  EXPECT_LE(largest.rotation_rad, kSameRotation_rad);
  EXPECT_EQ(answers.back().ready.frames, frames.size());
  EXPECT_EQ(answers.back().ready.packets_corrupt, 0U);
  EXPECT_EQ(answers.back().odometry.time_usec,
            static_cast<std::uint64_t>(frames.back().frame.stamp_ns / 1000));
  EXPECT_EQ(board.connection().counters().bad_checksum, 0U);
}

INSTANTIATE_TEST_SUITE_P(Boards, BoardTest, ::testing::Values(kM7, kM55), [](const auto& instance) {
  return std::string(instance.param.machine).substr(5);
});

}  // namespace
}  // namespace disflow::firmware_test
