// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace disflow::apps {
namespace {

FrameResult Result(Status status, std::int64_t total_ns = 1'000'000) {
  FrameResult result;
  result.estimate.status = status;
  result.total_ns = total_ns;
  return result;
}

TEST(DurationHistogram, Percentiles_AreThoseOfTheSortedValuesToOnePercent) {
  std::mt19937_64 random(9);
  std::lognormal_distribution<double> duration_ns(15.0, 2.0);
  DurationHistogram histogram;
  std::vector<double> sorted;
  for (int i = 0; i < 10'000; ++i) {
    const double value_ns = std::floor(std::clamp(duration_ns(random), 1e3, 1e11));
    sorted.push_back(value_ns);
    histogram.Add(static_cast<std::int64_t>(value_ns));
  }
  std::sort(sorted.begin(), sorted.end());
  for (const double share : {0.01, 0.5, 0.9, 0.99, 1.0}) {
    const auto at = static_cast<std::size_t>(std::ceil(share * 10'000.0)) - 1;
    const double expected_ms = sorted[at] * 1e-6;
    EXPECT_NEAR(histogram.Percentile_ms(share), expected_ms, 0.01 * expected_ms) << share;
  }
}

TEST(DurationHistogram, NothingOrSenselessDurations_GiveFiniteNumbers) {
  DurationHistogram histogram;
  EXPECT_EQ(histogram.Percentile_ms(0.5), 0.0);
  for (const std::int64_t duration_ns :
       {std::int64_t{0}, std::int64_t{-5}, std::numeric_limits<std::int64_t>::min(),
        std::numeric_limits<std::int64_t>::max()}) {
    histogram.Add(duration_ns);
  }
  EXPECT_LT(histogram.Percentile_ms(0.5), 0.01);
  EXPECT_GT(histogram.Percentile_ms(1.0), 100'000.0);
  EXPECT_TRUE(std::isfinite(histogram.Percentile_ms(1.0)));
}

TEST(RunReport, FramesAndRegistered_AreCountedApart) {
  RunReport report;
  for (int i = 0; i < 3; ++i) report.Add(Result(Status::kOk));
  report.Add(Result(Status::kEmptyMask));
  report.Add(Result(Status::kRegistrationFailed));
  report.Add(Result(Status::kRegistrationFailed));
  EXPECT_EQ(report.frames(), 6);
  EXPECT_EQ(report.registered(), 3);
  EXPECT_EQ(report.most_frequent_fault(), Status::kRegistrationFailed);
  const std::string text = report.Format(2.0);
  EXPECT_NE(text.find("6 frames in 2.00 s (3.0/s), 3 with a measured pose"), std::string::npos);
  EXPECT_NE(text.find(", 1 empty_mask"), std::string::npos);
  EXPECT_NE(text.find(", 2 registration_failed"), std::string::npos);
}

TEST(RunReport, NoFaults_NamesNone) {
  RunReport report;
  EXPECT_EQ(report.most_frequent_fault(), Status::kOk);
  report.Add(Result(Status::kOk));
  EXPECT_EQ(report.most_frequent_fault(), Status::kOk);
  EXPECT_NE(report.Format(1.0).find("rejected: nothing"), std::string::npos);
}

TEST(RunReport, EmptyRun_HasNumbersToo) {
  const std::string text = RunReport().Format(0.0);
  EXPECT_NE(text.find("0 frames"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
  EXPECT_EQ(text.find("inf"), std::string::npos) << text;
}

TEST(RunReport, EveryCounterOfRejection_IsShown) {
  // The first three are told by the statuses; one more is part of the unmatched.
  FrameResult result = Result(Status::kOk);
  std::fill_n(reinterpret_cast<std::uint32_t*>(&result.totals), Counters::kCount, 7U);
  RunReport report;
  report.Add(result);
  const std::string text = report.Format(1.0);
  const std::string rejected = text.substr(text.find("rejected:"));
  EXPECT_GE(std::count(rejected.begin(), rejected.end(), '7'), Counters::kCount - 4) << rejected;
}

TEST(RunReport, CoarserModel_IsSaidOnlyIfTheObjectAskedForOne) {
  RunReport as_set;
  as_set.Add(Result(Status::kOk));
  EXPECT_EQ(as_set.Format(1.0).find("coarser"), std::string::npos);
  FrameResult result = Result(Status::kOk);
  result.model_coarseness = 1.63F;
  RunReport report;
  report.Add(result);
  EXPECT_NE(report.Format(1.0).find("1.6 times coarser than set"), std::string::npos);
}

TEST(RunReport, TroubleOfTheSensor_IsSaidOnlyIfThereWasAny) {
  FrameResult result = Result(Status::kOk);
  RunReport calm;
  calm.Add(result);
  EXPECT_EQ(calm.Format(1.0).find("came back"), std::string::npos);
  result.sensor = {.frames = 9, .dropped = 5, .gaps = 2, .skipped = 3, .corrupt = 4};
  result.sensor.restarts = 6;
  result.sensor.reconnects = 8;
  RunReport report;
  report.Add(result);
  const std::string text = report.Format(1.0);
  EXPECT_NE(text.find("5 frames dropped (2 in the driver, 3 for a newer one), 4 corrupt, stream "
                      "stalled or failed 6 times, sensor came back 8 times"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace disflow::apps
