// SPDX-License-Identifier: BSD-3-Clause
#include "settings/dds_address.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "program/exit_status.h"
#include "refusal.h"

namespace disflow::apps {
namespace {

std::string Refusal(const std::string& uri) {
  return RefusalOf([&] { (void)ParseDdsAddress(uri); });
}

TEST(DdsAddress, EveryOption_IsTaken) {
  const DdsAddress address = ParseDdsAddress(
      "dds:domain=232&name=left_arm&interface=eth0&peer=10.0.0.2,robot.local,[fe80::1]&"
      "camera=cam/depth&world=map&mask=/seg/mask&ros=humble");
  EXPECT_EQ(address.domain, 232U);
  EXPECT_EQ(address.name, "left_arm");
  EXPECT_EQ(address.interface, "eth0");
  EXPECT_EQ(address.peers, (std::vector<std::string>{"10.0.0.2", "robot.local", "[fe80::1]"}));
  EXPECT_EQ(address.camera_frame, "cam/depth");
  EXPECT_EQ(address.world_frame, "map");
  EXPECT_EQ(address.mask_topic, "/seg/mask");
  EXPECT_TRUE(address.before_iron);
}

TEST(DdsAddress, WhatIsLeftOut_KeepsItsDefault) {
  const DdsAddress address = ParseDdsAddress("dds:domain=7");
  EXPECT_EQ(address.domain, 7U);
  EXPECT_EQ(address.name, "disflow");
  EXPECT_EQ(address.camera_frame, "camera_optical_frame");
  EXPECT_TRUE(address.peers.empty());
  EXPECT_TRUE(address.mask_topic.empty());
  EXPECT_FALSE(address.before_iron);
}

TEST(DdsAddress, OtherSchemes_AreNotMeant) {
  for (const char* uri : {"", "dd", "udp:host", "DDS:domain=0", " dds:"})
    EXPECT_FALSE(IsDdsAddress(uri)) << uri;
  EXPECT_TRUE(IsDdsAddress("dds:"));
}

struct Wrong {
  const char* uri;
  const char* said;
};
TEST(DdsAddress, EachWrongOption_IsNamedWithWhatItMayBe) {
  for (const Wrong& wrong : std::to_array<Wrong>({
           {"dds:", "write dds:domain=0"},
           {"dds:domain", "domain is not OPTION=VALUE"},
           {"dds:domain=233", "from 0 to 232"},
           {"dds:domain=-1", "from 0 to 232"},
           {"dds:domain=1x", "from 0 to 232"},
           {"dds:domain=", "from 0 to 232"},
           {"dds:domain=1&domain=1", "domain is given twice"},
           {"dds:name=2arms", "no ROS name"},
           {"dds:name=a/b", "no ROS name"},
           {"dds:name=", "no ROS name"},
           {"dds:interface=<x>", "no network interface"},
           {"dds:peer=a,,b", "is no host"},
           {"dds:peer=", "is no host"},
           {"dds:camera=/absolute", "no tf frame"},
           {"dds:world=", "no tf frame"},
           {"dds:mask=relative", "no topic"},
           {"dds:mask=/ends/", "no topic"},
           {"dds:ros=foxy", "neither humble"},
           {"dds:rate=5", "unknown option rate"},
       })) {
    const std::string said = Refusal(wrong.uri);
    EXPECT_NE(said.find(wrong.said), std::string::npos) << wrong.uri << ": " << said;
  }
}

TEST(DdsAddress, TooManyPeers_AreRefused) {
  std::string uri = "dds:peer=h";
  for (int i = 1; i < 16; ++i) uri += ",h";
  EXPECT_EQ(ParseDdsAddress(uri).peers.size(), 16U);
  EXPECT_NE(Refusal(uri + ",h").find("more than 16"), std::string::npos);
}

TEST(DdsAddress, AnyBytes_AreTakenOrRefusedInPrintableWords) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<int> length(0, 300);
  const std::string likely = "dds:domain=&name=peer,/_.mask";
  for (int i = 0; i < 5000; ++i) {
    std::string uri = "dds:";
    for (int n = length(random); n > 0; --n) {
      const int b = byte(random);
      uri += b < 128 ? likely[static_cast<std::size_t>(b) % likely.size()] : static_cast<char>(b);
    }
    for (const char c : Refusal(uri)) ASSERT_TRUE(c >= ' ' && c <= '~');
  }
}

}  // namespace
}  // namespace disflow::apps
