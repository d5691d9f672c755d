// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/open_sensor.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "disflow/host/simulation_options.h"
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

TEST(SensorHelp, NamesEveryObjectOfTheSimulationInLinesThatFit) {
  constexpr std::size_t kWidth = 100;
  const std::string help = SensorHelp();
  const std::vector<std::string_view> names = ListSimulationObjects();
  EXPECT_GT(names.size(), 10U);
  for (const std::string_view name : names) {
    EXPECT_NE(help.find(" " + std::string(name) + ","), std::string::npos) << name;
    SimulationOptions options;
    EXPECT_TRUE(SetSimulationObject(name, options).ok()) << name;
  }
  std::istringstream lines(help.substr(help.find("sim:OBJECT")));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), kWidth) << line;
}

}  // namespace
}  // namespace disflow::host
