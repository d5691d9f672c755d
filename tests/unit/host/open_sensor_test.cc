// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/open_sensor.h"

#include <gtest/gtest.h>

#include <string>

#include "recorded_sequence.h"

namespace disflow::host {
namespace {

TEST(OpenSensor, SimulationAddress_GivesAnOpenSensorThatKnowsTheTruth) {
  Sensor sensor;
  const hal::Fault fault = OpenSensor("sim:bottle?frames=2&width=64&height=48", sensor);
  ASSERT_TRUE(fault.ok()) << fault.message;
  DepthFrame frame;
  ASSERT_TRUE(sensor.get()->Next(0, frame).ok());
  EXPECT_EQ(frame.depth.width_px, 64);
  ASSERT_NE(sensor.simulated(), nullptr);
  EXPECT_EQ(sensor.simulated()->truth().stamp_ns, frame.stamp_ns);
}

TEST_F(RecordedSequence, ReplayAddress_GivesAnOpenSensor) {
  Sensor sensor;
  const hal::Fault fault = OpenSensor("replay:" + path().string() + "?mask=none", sensor);
  ASSERT_TRUE(fault.ok()) << fault.message;
  DepthFrame frame;
  ASSERT_TRUE(sensor.get()->Next(0, frame).ok());
  EXPECT_FALSE(frame.mask.given());
  EXPECT_EQ(sensor.simulated(), nullptr);
}

TEST(OpenSensor, UnknownScheme_ListsTheKnownOnes) {
  Sensor sensor;
  const hal::Fault fault = OpenSensor("warp:drive", sensor);
  EXPECT_EQ(fault.status, Status::kInvalidUri);
  for (const char* known : {"warp", "replay:", "sim:"}) {
    EXPECT_NE(std::string(fault.message).find(known), std::string::npos) << fault.message;
  }
}

TEST(OpenSensor, MissingObjOrFolder_IsNotFound) {
  Sensor sensor;
  EXPECT_EQ(OpenSensor("sim:obj:/nonexistent.obj", sensor).status, Status::kNotFound);
  EXPECT_EQ(OpenSensor("replay:/nonexistent", sensor).status, Status::kNotFound);
}

TEST(SensorHelp, NamesEveryOptionOfTheSimulation) {
  const std::string help = SensorHelp();
  for (const char* key : {"motion=", "noise=", "seed=", "occluder=", "drop=", "camera=", "mask=",
                          "format=", "first=", "scale="}) {
    EXPECT_NE(help.find(key), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace disflow::host
