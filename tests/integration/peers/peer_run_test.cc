// SPDX-License-Identifier: BSD-3-Clause
#include "peer_run.h"

#include <gtest/gtest.h>

#include <memory>

#include "allocation_count.h"
#include "estimate_csv.h"
#include "program/exit_status.h"
#include "scratch_dir.h"

namespace disflow::bench {
namespace {

constexpr const char* kSensor = "sim:bottle?motion=fast&frames=6&width=320&height=180";

PeerOptions OptionsFor(const apps::ScratchDir& folder, Method method) {
  PeerOptions options;
  options.sensor = kSensor;
  options.csv = folder.path() / "run.csv";
  options.method = method;
  options.icp.voxel_m = 0.005F;
  return options;
}

TEST(AllocationCount, CountsEveryOne) {
  const long before = AllocationCount();
  constexpr int kMany = 5;
  std::vector<std::unique_ptr<int>> many;
  for (int i = 0; i < kMany; ++i) many.push_back(std::make_unique<int>(i));
  EXPECT_GE(AllocationCount() - before, kMany);
}

TEST(PeerRun, TrackerAllocatesNothingPerFrame) {
  const apps::ScratchDir folder;
  const PeerCost cost = RunPeer(OptionsFor(folder, Method::kDisflow));
  EXPECT_EQ(cost.frames, 6);
  EXPECT_EQ(cost.allocations_per_frame, 0.0);
  EXPECT_GT(cost.memory_bytes, 1 << 19);
}

TEST(PeerRun, IcpSaysWhatItCosts) {
  const apps::ScratchDir folder;
  const PeerCost cost = RunPeer(OptionsFor(folder, Method::kIcp));
  EXPECT_EQ(cost.frames, 6);
  EXPECT_GT(cost.allocations_per_frame, 100.0);
  EXPECT_GT(cost.median_ms, 0.0);
  EXPECT_GT(cost.memory_bytes, 0);
}

TEST(PeerRun, ExtrapolatedVelocity_IsThatAtTheEndOfTheLastOfTwoIntervals) {
  const apps::ScratchDir folder;
  PeerOptions options = OptionsFor(folder, Method::kIcp);
  options.csv_extrapolated = folder.path() / "extrapolated.csv";
  (void)RunPeer(options);
  const auto plain = apps::LoadEstimates(options.csv, 6).rows;
  const auto extrapolated = apps::LoadEstimates(options.csv_extrapolated, 6).rows;
  ASSERT_EQ(plain.size(), 6U);
  ASSERT_EQ(extrapolated.size(), 6U);
  for (std::size_t i = 2; i < 6; ++i) {
    const apps::Vec3d wanted =
        1.5 * plain[i].twist.linear_mps - 0.5 * plain[i - 1].twist.linear_mps;
    EXPECT_LT((extrapolated[i].twist.linear_mps - wanted).norm(), 1e-5) << i;
    EXPECT_EQ(extrapolated[i].T_co.translation(), plain[i].T_co.translation()) << i;
  }
  // Before the second interval there is nothing to extrapolate from.
  EXPECT_EQ(extrapolated[1].twist.linear_mps, plain[1].twist.linear_mps);
}

TEST(PeerRun, SequenceThatIsNotThere_IsAnInputThatFailed) {
  const apps::ScratchDir folder;
  PeerOptions options = OptionsFor(folder, Method::kIcp);
  options.sensor = "replay:" + (folder.path() / "nothing").string();
  const std::string message = apps::MessageOf<apps::Failure>([&] { (void)RunPeer(options); });
  EXPECT_NE(message.find("nothing"), std::string::npos) << message;
}

}  // namespace
}  // namespace disflow::bench
