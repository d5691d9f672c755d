// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a frame costs, counted in instructions: the emulator lets each take 2^10 ns.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "target_run.h"

namespace disflow::firmware_test {
namespace {

constexpr int kShift = 10;
constexpr std::size_t kWhole = 300;
constexpr std::size_t kRepeated = 20;
/// First frames, in which the model is made and the velocity is not known.
constexpr std::size_t kStart = 5;

using Counts = std::vector<std::array<std::int64_t, kStageCount + 1>>;  // stages, then the frame

Counts InstructionsOf(const std::vector<apps::BoardAnswer>& answers) {
  const auto count = [](std::uint64_t ns) {
    return static_cast<std::int64_t>((ns + (1U << (kShift - 1))) >> kShift);
  };
  Counts counts;
  for (const apps::BoardAnswer& answer : answers) {
    auto& row = counts.emplace_back();
    for (std::size_t i = 0; i < kStageCount; ++i) row[i] = count(answer.timing.stage_ns[i]);
    row[kStageCount] = count(answer.timing.frame_ns);
  }
  return counts;
}

struct Spread {
  std::int64_t median = 0;
  std::int64_t p99 = 0;
  std::int64_t longest = 0;
};

Spread SpreadOf(const Counts& counts, std::size_t column, std::size_t first) {
  std::vector<std::int64_t> values;
  for (std::size_t i = first; i < counts.size(); ++i) values.push_back(counts[i][column]);
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values[values.size() * 99 / 100], values.back()};
}

/// In millions: median, 99th percentile, most after the start, most.
void Print(const Counts& counts, const char* name) {
  for (std::size_t i = 0; i <= kStageCount; ++i) {
    const char* const stage = i < kStageCount ? Name(static_cast<Stage>(i)) : "whole frame";
    const Spread spread = SpreadOf(counts, i, 0);
    const Spread later = SpreadOf(counts, i, kStart);
    std::printf("| %s | %s | %.2f | %.2f | %.2f | %.2f |\n", name, stage,
                static_cast<double>(spread.median) * 1e-6, static_cast<double>(spread.p99) * 1e-6,
                static_cast<double>(later.longest) * 1e-6,
                static_cast<double>(spread.longest) * 1e-6);
  }
}

class TimingTest : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (const std::string missing = Emulator::Missing(kM7); !missing.empty()) {
      GTEST_SKIP() << missing;
    }
  }
};

TEST_P(TimingTest, InstructionsPerFrame_AreBoundedAndTheSameInEveryRun) {
  const std::vector<Frame> frames = MakeSequence(GetParam(), "white", kWhole);
  EmulatorOptions options;
  options.icount_shift = kShift;
  const auto answers = RunRecorded(options, frames, kWhole);
  const Counts counts = InstructionsOf(answers);
  Print(counts, GetParam().c_str());
  const auto slowest = std::max_element(
      counts.begin(), counts.end(),
      [](const auto& a, const auto& b) { return a[kStageCount] < b[kStageCount]; });
  std::printf("slowest frame %td; stack %u bytes\n", slowest - counts.begin(),
              answers.back().timing.stack_bytes);

  // Bounded by capacities and budgets, not by what the images show.
  const Spread whole = SpreadOf(counts, kStageCount, 0);
  EXPECT_LT(whole.p99, 2 * whole.median);
  EXPECT_LT(whole.longest, 3 * whole.median);

  const Counts again = InstructionsOf(RunRecorded(options, frames, kRepeated));
  for (std::size_t i = 0; i < kRepeated; ++i) EXPECT_EQ(again[i], counts[i]) << "frame " << i;
}

INSTANTIATE_TEST_SUITE_P(Fast, TimingTest, ::testing::Values("box", "bottle"),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace disflow::firmware_test
