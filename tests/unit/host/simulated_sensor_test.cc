// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/simulated_sensor.h"

#include <gtest/gtest.h>

#include "disflow/host/simulated_shapes.h"

namespace disflow::host {
namespace {

SimulationOptions Tiny(int frames) {
  SimulationOptions options;
  options.frames = frames;
  options.width_px = 64;
  options.height_px = 48;
  return options;
}

TEST(SimulatedSensor, DeliversEveryFrameOnceAndThenEnds) {
  const SimulationOptions options = Tiny(7);
  SimulatedSensor sensor(options, MakeObjectMesh(options.object));
  DepthFrame frame;
  EXPECT_EQ(sensor.Next(0, frame).status, Status::kNotOpen);
  ASSERT_TRUE(sensor.Open().ok());
  StampNs last_ns = 0;
  for (int i = 0; i < 7; ++i) {
    ASSERT_TRUE(sensor.Next(0, frame).ok());
    EXPECT_EQ(CheckFrame(frame, 64, 48), Status::kOk);
    EXPECT_GT(frame.stamp_ns, last_ns);
    EXPECT_EQ(sensor.truth().stamp_ns, frame.stamp_ns);
    last_ns = frame.stamp_ns;
  }
  EXPECT_EQ(sensor.Next(0, frame).status, Status::kEndOfStream);
  EXPECT_EQ(sensor.counters().frames, 7U);
  EXPECT_EQ(sensor.info().width_px, 64);
  EXPECT_EQ(sensor.info().height_px, 48);
  EXPECT_FALSE(sensor.info().live);
}

TEST(SimulatedSensor, OpenedAgain_StartsAnew) {
  const SimulationOptions options = Tiny(3);
  SimulatedSensor sensor(options, MakeObjectMesh(options.object));
  DepthFrame frame;
  ASSERT_TRUE(sensor.Open().ok());
  ASSERT_TRUE(sensor.Next(0, frame).ok());
  const StampNs first_ns = frame.stamp_ns;
  ASSERT_TRUE(sensor.Next(0, frame).ok());
  ASSERT_TRUE(sensor.Open().ok()) << "idempotent";
  ASSERT_TRUE(sensor.Next(0, frame).ok());
  EXPECT_GT(frame.stamp_ns, first_ns) << "opening an open sensor must not rewind it";
  sensor.Close();
  ASSERT_TRUE(sensor.Open().ok());
  ASSERT_TRUE(sensor.Next(0, frame).ok());
  EXPECT_EQ(frame.stamp_ns, first_ns);
}

TEST(SimulatedSensor, DroppedFrames_LeaveGapsInTheStampsAndAreCounted) {
  SimulationOptions options = Tiny(400);
  options.drop = 0.2;
  SimulatedSensor sensor(options, MakeObjectMesh(options.object));
  ASSERT_TRUE(sensor.Open().ok());
  DepthFrame frame;
  StampNs last_ns = 0;
  int longer = 0;
  while (sensor.Next(0, frame).ok()) {
    const double gap_s = static_cast<double>(frame.stamp_ns - last_ns) * 1e-9;
    if (last_ns != 0 && gap_s > 0.05) ++longer;
    last_ns = frame.stamp_ns;
  }
  const hal::SensorCounters counters = sensor.counters();
  EXPECT_EQ(counters.frames + counters.dropped, 400U);
  EXPECT_NEAR(counters.dropped, 80.0, 30.0);
  EXPECT_GT(longer, 30);
}

TEST(SimulatedSensor, FirstFrame_IsNeverDropped) {
  SimulationOptions options = Tiny(2);
  options.drop = 0.9;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    options.seed = seed;
    EXPECT_FALSE(Simulation(options, MakeObjectMesh(options.object)).IsDropped(0));
  }
}

}  // namespace
}  // namespace disflow::host
