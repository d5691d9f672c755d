// SPDX-License-Identifier: BSD-3-Clause
#include "view/run_metrics.h"

#include <gtest/gtest.h>

#include <sstream>

namespace disflow::apps {
namespace {

/// The value of a metric with its labels; NaN if it is not there once.
double ValueOf(const std::string& text, const std::string& metric) {
  std::istringstream lines(text);
  double value = std::nan("");
  int found = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(metric + " ")) continue;
    value = std::stod(line.substr(metric.size() + 1));
    ++found;
  }
  return found == 1 ? value : std::nan("");
}

FrameResult Result(double ms, std::uint8_t reset_counter = 0) {
  FrameResult result;
  result.total_ns = static_cast<std::int64_t>(ms * 1e6);
  result.estimate.reset_counter = reset_counter;
  result.estimate.state = TrackingState::kDegraded;
  result.estimate.quality = 40;
  return result;
}

TEST(RunMetrics, NewestTotals_AreThoseOfEachObject) {
  RunMetrics metrics("1.2 \"x\"", {"box", "bottle"});
  FrameResult result = Result(1.0);
  result.totals.frames = 7;
  result.totals.clusters_evicted = 4294967295U;
  result.sensor.dropped = 3;
  result.recording_dropped = 9;
  result.model_coarseness = 1.5F;
  metrics.Add(0, result);
  metrics.SetLost(0, 5);
  const std::string text = metrics.Text();
  EXPECT_EQ(ValueOf(text, "disflow_frames_total{object=\"box\"}"), 7.0);
  EXPECT_EQ(ValueOf(text, "disflow_clusters_evicted_total{object=\"box\"}"), 4294967295.0);
  EXPECT_EQ(ValueOf(text, "disflow_sensor_dropped_total"), 3.0);
  EXPECT_EQ(ValueOf(text, "disflow_recording_dropped_total"), 9.0);
  EXPECT_EQ(ValueOf(text, "disflow_results_not_seen_total{object=\"box\"}"), 5.0);
  EXPECT_EQ(ValueOf(text, "disflow_quality{object=\"box\"}"), 40.0);
  EXPECT_EQ(ValueOf(text, "disflow_model_coarseness{object=\"box\"}"), 1.5);
  EXPECT_EQ(ValueOf(text, "disflow_state{object=\"box\",state=\"degraded\"}"), 1.0);
  EXPECT_EQ(ValueOf(text, "disflow_state{object=\"box\",state=\"tracking\"}"), 0.0);
  EXPECT_TRUE(std::isnan(ValueOf(text, "disflow_frames_total{object=\"bottle\"}")))
      << "of an object without a result nothing is known";
  EXPECT_NE(text.find("version=\"1.2 \\\"x\\\"\""), std::string::npos);
}

TEST(RunMetrics, Histogram_CountsEveryFrameUpToEachBound) {
  RunMetrics metrics("", {"box"});
  for (const double ms : {0.1, 0.4, 0.6, 1.5, 30.0, 500.0}) metrics.Add(0, Result(ms));
  const std::string text = metrics.Text();
  const auto bucket = [&](const std::string& end) {
    return ValueOf(text, "disflow_frame_seconds_bucket{object=\"box\",le=\"" + end + "\"}");
  };
  EXPECT_EQ(bucket("0.0005"), 2.0);
  EXPECT_EQ(bucket("0.001"), 3.0);
  EXPECT_EQ(bucket("0.002"), 4.0);
  EXPECT_EQ(bucket("0.02"), 4.0);
  EXPECT_EQ(bucket("0.033"), 5.0);
  EXPECT_EQ(bucket("0.1"), 5.0);
  EXPECT_EQ(bucket("+Inf"), 6.0);
  EXPECT_EQ(ValueOf(text, "disflow_frame_seconds_count{object=\"box\"}"), 6.0);
  EXPECT_NEAR(ValueOf(text, "disflow_frame_seconds_sum{object=\"box\"}"), 0.5326, 1e-9);
}

TEST(RunMetrics, RestartsGoOnCountingWhereTheEstimatesCounterStartsAgain) {
  RunMetrics metrics("", {"box"});
  for (const int counter : {254, 255, 0, 0, 2}) {
    metrics.Add(0, Result(1.0, static_cast<std::uint8_t>(counter)));
  }
  EXPECT_EQ(ValueOf(metrics.Text(), "disflow_restarts_total{object=\"box\"}"), 4.0);
}

}  // namespace
}  // namespace disflow::apps
