// SPDX-License-Identifier: BSD-3-Clause
#include "settings/ros_arguments.h"

#include <gtest/gtest.h>

#include "parsed.h"
#include "refusal.h"
#include "scratch_folder.h"

namespace disflow::apps {
namespace {

using Words = std::vector<std::string>;

/// A program that is fed by ROS 2 and speaks to it, with what ROS hands over.
Options Node(const Words& of_ros) {
  Words all = {"--sensor", "dds:domain=3&depth=/d", "--link", "dds:domain=3&mask=/m", "--ros-args"};
  all.insert(all.end(), of_ros.begin(), of_ros.end());
  return Parsed(all);
}

TEST(RosArguments, Topics_TakeThePlaceOfThoseInTheAddresses) {
  const Options options = Node({"-r", "depth:=/camera/depth/image_rect_raw", "--remap",
                                "info:=/camera/info", "-r", "mask:=/segmenter/mask"});
  const DdsSensorAddress sensor = ParseDdsSensorAddress(options.sensor);
  EXPECT_EQ(sensor.depth_topic, "/camera/depth/image_rect_raw");
  EXPECT_EQ(sensor.info_topic, "/camera/info");
  EXPECT_EQ(sensor.domain, 3U);
  EXPECT_EQ(ParseDdsAddress(options.dds_link).mask_topic, "/segmenter/mask");
}

TEST(RosArguments, AddressesWithoutATopic_GetIt) {
  for (const char* const uri : {"dds:", "dds:domain=0"}) {
    const Options options = Parsed({"--sensor", uri, "--ros-args", "-r", "depth:=/a/rect"});
    EXPECT_EQ(ParseDdsSensorAddress(options.sensor).depth_topic, "/a/rect");
  }
}

TEST(RosArguments, NodeAndNamespace_AreThoseOfSensorAndLink) {
  for (const char* const name : {"__node:=eye", "__name:=eye"}) {
    const Options options = Node({"-r", "__ns:=/robot1/head", "-r", name});
    for (const DdsNodeAddress& node : {DdsNodeAddress(ParseDdsSensorAddress(options.sensor)),
                                       DdsNodeAddress(ParseDdsAddress(options.dds_link))}) {
      EXPECT_EQ(node.FullName(), "/robot1/head/eye");
    }
  }
  EXPECT_EQ(NodeOf({}, Node({"-r", "__ns:=/"})).FullName(), "/disflow");
}

TEST(RosArguments, RelativeTopics_AreTheNamespacesAndTildeIsTheNode) {
  const Options options = Node({"-r", "depth:=camera/depth", "-r", "mask:=~/mask", "-r",
                                "__node:=eye", "-r", "__ns:=robot1"});
  EXPECT_EQ(ParseDdsSensorAddress(options.sensor).depth_topic, "/robot1/camera/depth");
  EXPECT_EQ(ParseDdsAddress(options.dds_link).mask_topic, "/robot1/eye/mask");
}

TEST(RosArguments, Section_EndsWithTwoDashesAndMayComeAgain) {
  const Options options = Parsed({"--ros-args", "-r", "depth:=/a", "--", "--sensor", "dds:domain=1",
                                  "--frames", "7", "--ros-args", "-r", "__node:=eye"});
  const DdsSensorAddress sensor = ParseDdsSensorAddress(options.sensor);
  EXPECT_EQ(sensor.depth_topic, "/a");
  EXPECT_EQ(sensor.name, "eye");
  EXPECT_EQ(options.frames, 7);
}

TEST(RosArguments, Parameters_AreSettingsAndOptionsAndYieldToWhatIsTyped) {
  const Words of_ros = {"-p", "registration.iterations:=9",
                        "-p", "use_sim_time:=false",
                        "-p", "object.registration.iterations:=12",
                        "-p", "run.rate:=realtime",
                        "-p", "run.range:=[0.2, 1.5]",
                        "-p", "run.headless:=true"};
  const Options options = Node(of_ros);
  EXPECT_EQ(options.objects.at(0).config.registration.iterations, 12);
  EXPECT_EQ(options.objects.at(0).config.segmenter.max_range_m, 1.5F);
  EXPECT_EQ(options.rate, Rate::kRealtime);
  EXPECT_TRUE(options.headless);
  Words typed = of_ros;
  typed.insert(typed.end(), {"--", "--set", "registration.iterations=4", "--rate", "max"});
  EXPECT_EQ(Node(typed).objects.at(0).config.registration.iterations, 4);
  EXPECT_EQ(Node(typed).rate, Rate::kMax);
}

class RosArgumentsAndFile : public test::ScratchFolderTest {};

TEST_F(RosArgumentsAndFile, ParametersFile_IsThatOfTheNodeInItsNamespaceAndSingleOnesWin) {
  test::WriteFile(Path("params.yaml"),
                  "disflow:\n  ros__parameters: {registration.iterations: 5}\n"
                  "/robot1/eye:\n  ros__parameters: {registration.iterations: 6, run.frames: 9}\n");
  const auto with = [this](Words of_ros) {
    of_ros.insert(of_ros.end(), {"--params-file", Path("params.yaml")});
    return of_ros;
  };
  const auto iterations = [](const Options& options) {
    return options.objects.at(0).config.registration.iterations;
  };
  EXPECT_EQ(iterations(Node(with({}))), 5);
  const Words eye = {"-r", "__node:=eye", "-r", "__ns:=/robot1"};
  EXPECT_EQ(iterations(Node(with(eye))), 6);
  EXPECT_EQ(Node(with(eye)).frames, 9);
  Words single = eye;
  single.insert(single.end(), {"-p", "registration.iterations:=8"});
  EXPECT_EQ(iterations(Node(with(single))), 8);
  // Without an address the node is who ROS says.
  Words simulated =
      with({"--sensor", "sim:box", "--ros-args", "-r", "__node:=eye", "-r", "__ns:=/robot1"});
  EXPECT_EQ(iterations(Parsed(simulated)), 6);
}

TEST_F(RosArgumentsAndFile, AddressesOfTheFile_AreToldAsThoseThatWereTyped) {
  test::WriteFile(
      Path("params.yaml"),
      "/**:\n  ros__parameters:\n    run: {sensor: 'dds:domain=4', link: 'dds:domain=4'}\n");
  const Options options = Parsed({"--ros-args", "-r", "depth:=/a", "-r", "__node:=eye", "-r",
                                  "mask:=/m", "--params-file", Path("params.yaml")});
  EXPECT_EQ(ParseDdsSensorAddress(options.sensor).depth_topic, "/a");
  EXPECT_EQ(ParseDdsAddress(options.dds_link).name, "eye");
  EXPECT_EQ(ParseDdsAddress(options.dds_link).mask_topic, "/m");
}

TEST(RosArguments, WhatMeansNothingHere_IsNamedWithWhatWould) {
  struct Wrong {
    Words of_ros;
    const char* named;
    const char* helps;
  };
  for (const Wrong& wrong : {
           Wrong{
               {"-r", "/disflow/object/pose:=/pose"}, "/disflow/object/pose:=/pose", "depth, info"},
           Wrong{{"-r", "disflow:depth:=/a"}, "disflow:depth", "before the first colon"},
           Wrong{{"-r", "depth=/a"}, "depth=/a", "NAME:=VALUE"},
           Wrong{{"-r", "depth:="}, "depth:=", "NAME:=VALUE"},
           Wrong{{"-r"}, "-r", "FROM:=TO is missing"},
           Wrong{{"-r", "depth:=/a&wait=1"}, "/a&wait=1", "no &"},
           Wrong{{"-r", "depth:=/{node}"}, "/{node}", "no topic"},
           Wrong{{"-r", "__ns:=/a//&"}, "/a//&", "no &"},
           Wrong{{"-r", "__ns:=/a/"}, "/a/", "no namespace"},
           Wrong{{"-r", "__node:=a b"}, "a b", "no ROS name"},
           Wrong{{"-p", "registration.iterations:=99"},
                 "registration.iterations:=99",
                 "out of range"},
           Wrong{{"-p", "registration.iterations:=[1"}, "registration.iterations:=[1", ""},
           Wrong{{"-p", "speed:=1"}, "speed:=1", "no parameter speed"},
           Wrong{{"-p", "speed"}, "-p speed", "NAME:=VALUE"},
           Wrong{{"--log-level", "debug"}, "--log-level", "known are -r"},
           Wrong{{"--enclave", "/a"}, "--enclave", "known are -r"},
           Wrong{{"--disable-rosout-logs"}, "--disable-rosout-logs", "known are -r"},
       }) {
    const std::string said = RefusalOf([&] { (void)Node(wrong.of_ros); });
    EXPECT_NE(said.find(wrong.named), std::string::npos) << wrong.named << " not in: " << said;
    EXPECT_NE(said.find(wrong.helps), std::string::npos) << wrong.helps << " not in: " << said;
  }
}

TEST(RosArguments, TopicsThatNobodyReads_AreNamed) {
  const auto refusal = [](const char* rule) {
    return RefusalOf([rule] { (void)Parsed({"--sensor", "sim:box", "--ros-args", "-r", rule}); });
  };
  EXPECT_NE(refusal("depth:=/a").find("depth:=/a: needs a sensor of ROS 2"), std::string::npos);
  EXPECT_NE(refusal("mask:=/a").find("mask:=/a: needs a link to ROS 2"), std::string::npos);
}

}  // namespace
}  // namespace disflow::apps
