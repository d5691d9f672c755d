// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>

#include "disflow/host/stereo_camera.h"
#include "sensor_statistics.h"

/// @file
/// The statistics of docs/sequences.md: what a sensor model adds to the truth.

namespace disflow::host {
namespace {

SensorStatistics MeasureModel(NoiseKind noise, const char* name) {
  SensorMeasurement measurement;
  for (const ObjectKind object : {ObjectKind::kBox, ObjectKind::kBottle}) {
    for (const std::uint64_t seed : {1U, 2U}) {
      SimulationOptions options;
      options.object = object;
      options.noise = noise;
      options.seed = seed;
      measurement.Add(options, 2);
    }
  }
  const SensorStatistics s = measurement.Result();
  std::printf(
      "| %s | %.3f (%.3f) | %.2f, %.2f, %.2f, %.2f | %.2f | %.0f / %.0f | %.2f (%.1f) | %.2f | "
      "%.2f ± %.2f mm |\n",
      name, s.std_px, s.facing_std_px, s.correlation_1px, s.correlation_2px, s.correlation_4px,
      s.correlation_8px, s.correlation_next_frame, 100.0 * s.fattened_2px, 100.0 * s.fattened_4px,
      100.0 * s.hole_share, 100.0 * s.grazing_hole_share, 100.0 * s.gross_share,
      1e3 * s.depth_mean_m, 1e3 * s.depth_std_m);
  return s;
}

TEST(SensorModel, White_IsIndependentAndHasSharpOutlines) {
  const SensorStatistics s = MeasureModel(NoiseKind::kWhite, "white");
  EXPECT_NEAR(s.std_px, 0.08, 0.002);
  EXPECT_LT(std::abs(s.correlation_1px), 0.02);
  EXPECT_LT(std::abs(s.correlation_next_frame), 0.02);
  EXPECT_LT(s.fattened_2px, 0.03);  // flying pixels where an outline is concave
}

TEST(SensorModel, D415_HasTheSpreadOfWhiteNoiseCorrelatedInSpaceAndTime) {
  const SensorStatistics s = MeasureModel(NoiseKind::kD415, "d415");
  EXPECT_NEAR(s.std_px, 0.08, 0.004);
  EXPECT_LT(std::abs(s.mean_px), 0.01);
  // exp(-r^2 / (4 1.5^2)), less where a slanted surface runs through layers of disparity.
  EXPECT_NEAR(s.correlation_1px, 0.87, 0.06);
  EXPECT_NEAR(s.correlation_2px, 0.60, 0.08);
  EXPECT_NEAR(s.correlation_4px, 0.15, 0.07);
  EXPECT_NEAR(s.correlation_8px, 0.0, 0.06);
  EXPECT_NEAR(s.correlation_next_frame, 0.7, 0.04);
  EXPECT_NEAR(s.fattened_2px, 0.53, 0.12);
  EXPECT_NEAR(s.fattened_4px, 0.11, 0.06);
  EXPECT_GT(s.hole_share, 0.002);
  EXPECT_LT(s.hole_share, 0.01);
}

TEST(SensorModel, Tof_IsBiasedByMillimetresAndNoisy) {
  const SensorStatistics s = MeasureModel(NoiseKind::kTof, "tof");
  EXPECT_GT(s.depth_std_m, 0.001);
  EXPECT_LT(s.depth_std_m, 0.01);
  EXPECT_LT(std::abs(s.depth_mean_m), 0.006);
  EXPECT_LT(s.hole_share, 0.05);
}

TEST(SensorModel, Stereo_HasTheStatisticsOfARefinedMatcher) {
  if (!StereoIsAvailable()) GTEST_SKIP() << "built without OpenCV";
  const SensorStatistics s = MeasureModel(NoiseKind::kStereo, "stereo");
  EXPECT_NEAR(s.std_px, 0.15, 0.03);
  EXPECT_NEAR(s.facing_std_px, 0.11, 0.04);
  EXPECT_NEAR(s.correlation_2px, 0.48, 0.12);
  EXPECT_NEAR(s.correlation_4px, 0.09, 0.10);
  EXPECT_NEAR(s.correlation_next_frame, 0.70, 0.13);
  EXPECT_GT(s.fattened_2px, 0.15);  // the target is 0.53
  EXPECT_NEAR(s.fattened_4px, 0.11, 0.08);
  EXPECT_LT(s.hole_share, 0.02);
}

TEST(SensorModel, StereoRaw_HasTheStatisticsOfABadlyTunedMatcher) {
  if (!StereoIsAvailable()) GTEST_SKIP() << "built without OpenCV";
  const SensorStatistics s = MeasureModel(NoiseKind::kStereoRaw, "stereo-raw");
  EXPECT_NEAR(s.std_px, 0.18, 0.04);
  EXPECT_NEAR(s.correlation_2px, 0.68, 0.12);
  EXPECT_NEAR(s.correlation_4px, 0.29, 0.12);
  EXPECT_NEAR(s.correlation_next_frame, 0.70, 0.13);
  EXPECT_LT(s.hole_share, 0.02);
}

}  // namespace
}  // namespace disflow::host
