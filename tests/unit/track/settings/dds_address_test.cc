// SPDX-License-Identifier: BSD-3-Clause
#include "settings/dds_address.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>

#include "program/exit_status.h"
#include "refusal.h"

namespace disflow::apps {
namespace {

std::string Refusal(const std::string& uri) {
  return RefusalOf([&] { (void)ParseDdsAddress(uri); });
}

/// For as long as it lives ROS_DOMAIN_ID is as it says; nothing: not set.
class RosDomainId {
 public:
  explicit RosDomainId(const char* value) {
    if (const char* const before = std::getenv(kName); before != nullptr) before_ = before;
    Set(value);
  }
  ~RosDomainId() { Set(before_ ? before_->c_str() : nullptr); }
  RosDomainId(const RosDomainId&) = delete;
  RosDomainId& operator=(const RosDomainId&) = delete;

 private:
  static constexpr const char* kName = "ROS_DOMAIN_ID";
  static void Set(const char* value) {
    if (value == nullptr) {
      ::unsetenv(kName);
    } else {
      ::setenv(kName, value, 1);
    }
  }
  std::optional<std::string> before_;
};

TEST(DdsAddress, EveryOption_IsTaken) {
  const DdsAddress address = ParseDdsAddress(
      "dds:domain=232&name=left_arm&namespace=/robot1/"
      "body&interface=eth0&peer=10.0.0.2,robot.local,[fe80::1]&"
      "camera=cam/depth&world=map&mask=/seg/mask&reset=yes&choose=yes&parameters=yes&"
      "lifecycle=yes&ros=humble");
  EXPECT_EQ(address.domain, 232U);
  EXPECT_EQ(address.name, "left_arm");
  EXPECT_EQ(address.FullName(), "/robot1/body/left_arm");
  EXPECT_EQ(address.interface, "eth0");
  EXPECT_EQ(address.peers, (std::vector<std::string>{"10.0.0.2", "robot.local", "[fe80::1]"}));
  EXPECT_EQ(address.camera_frame, "cam/depth");
  EXPECT_EQ(address.world_frame, "map");
  EXPECT_EQ(address.mask_topic, "/seg/mask");
  EXPECT_TRUE(address.may_reset);
  EXPECT_TRUE(address.may_choose);
  EXPECT_TRUE(address.may_set);
  EXPECT_TRUE(address.may_pause);
  EXPECT_TRUE(address.before_iron);
}

TEST(DdsAddress, WhatIsLeftOut_KeepsItsDefault) {
  const DdsAddress address = ParseDdsAddress("dds:domain=7");
  EXPECT_EQ(address.domain, 7U);
  EXPECT_EQ(address.name, "disflow");
  EXPECT_EQ(address.camera_frame, "camera_optical_frame");
  EXPECT_TRUE(address.peers.empty());
  EXPECT_TRUE(address.mask_topic.empty());
  EXPECT_FALSE(address.may_choose);
  EXPECT_FALSE(address.may_set);
  EXPECT_FALSE(address.may_pause);
  EXPECT_FALSE(address.may_reset) << "who listens need not be who commands";
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
           {"dds:reset=1", "neither yes nor no"},
           {"dds:ros=foxy", "neither humble"},
           {"dds:rate=5", "unknown option rate"},
       })) {
    const std::string said = Refusal(wrong.uri);
    EXPECT_NE(said.find(wrong.said), std::string::npos) << wrong.uri << ": " << said;
  }
}

TEST(DdsAddress, ThatNamesNoDomain_IsInThatOfRos) {
  for (const auto& [value, domain] : {std::pair<const char*, std::uint32_t>{nullptr, 0},
                                      {"", 0},
                                      {"0", 0},
                                      {"42", 42},
                                      {"232", 232}}) {
    const RosDomainId of_ros(value);
    EXPECT_EQ(ParseDdsAddress("dds:").domain, domain);
    EXPECT_EQ(ParseDdsAddress("dds:name=eye").domain, domain);
    EXPECT_EQ(ParseDdsSensorAddress("dds:depth=/a").domain, domain);
    EXPECT_EQ(ParseDdsAddress("dds:domain=7").domain, 7U) << "what is said counts";
  }
}

TEST(DdsAddress, DomainOfRosThatIsNone_IsRefusedWhereItWouldCount) {
  for (const char* const value : {"233", "-1", "1x", " 1", "all"}) {
    const RosDomainId of_ros(value);
    const std::string said = Refusal("dds:name=eye");
    EXPECT_NE(said.find("ROS_DOMAIN_ID=" + std::string(value)), std::string::npos) << said;
    EXPECT_NE(said.find("from 0 to 232"), std::string::npos) << said;
    EXPECT_EQ(ParseDdsAddress("dds:domain=7").domain, 7U);
  }
}

TEST(DdsSensorAddress, EveryOption_IsTaken) {
  const DdsSensorAddress address = ParseDdsSensorAddress(
      "dds:domain=5&name=arm&interface=eth0&peer=10.0.0.2&ros=humble&depth=/cam/image/"
      "compressedDepth"
      "&info=/cam/info&rectified=no&wait=0");
  EXPECT_EQ(address.domain, 5U);
  EXPECT_EQ(address.name, "arm");
  EXPECT_EQ(address.interface, "eth0");
  EXPECT_EQ(address.peers, std::vector<std::string>{"10.0.0.2"});
  EXPECT_TRUE(address.before_iron);
  EXPECT_EQ(address.depth_topic, "/cam/image/compressedDepth");
  EXPECT_EQ(address.info_topic, "/cam/info");
  EXPECT_EQ(address.rectified, false);
  EXPECT_EQ(address.wait_s, 0U);
}

TEST(DdsSensorAddress, WhatIsLeftOut_KeepsItsDefault) {
  const DdsSensorAddress address = ParseDdsSensorAddress("dds:depth=/depth");
  EXPECT_EQ(address.info_topic, "");
  EXPECT_FALSE(address.rectified.has_value());
  EXPECT_GT(address.wait_s, 0U);
}

TEST(DdsSensorAddress, EachWrongOption_IsNamedWithWhatItMayBe) {
  for (const Wrong& wrong : std::to_array<Wrong>({
           {"dds:", "write dds:domain=0&depth=/"},
           {"dds:domain=0", "depth= is missing"},
           {"dds:depth=", "no topic"},
           {"dds:depth=image", "no topic"},
           {"dds:depth=/a&info=b", "info=b is no topic"},
           {"dds:depth=/a&depth=/a", "depth is given twice"},
           {"dds:depth=/a&rectified=1", "neither yes nor no"},
           {"dds:depth=/a&wait=-1", "wait=-1 is not a number"},
           {"dds:depth=/a&wait=86401", "from 0 to 86400"},
           {"dds:depth=/a&world=map", "unknown option world"},
       })) {
    const std::string said = RefusalOf([&] { (void)ParseDdsSensorAddress(wrong.uri); });
    EXPECT_NE(said.find(wrong.said), std::string::npos) << wrong.uri << ": " << said;
  }
  EXPECT_NE(Refusal("dds:depth=/a").find("unknown option depth"), std::string::npos);
}

TEST(DdsSensorAddress, WithALinkInItsDomain_BothAreOneNodeOfWhatEitherSays) {
  const DdsNodeAddress node =
      SensorNode(ParseDdsSensorAddress("dds:domain=1&depth=/a&interface=lo&name=eye"),
                 "dds:domain=1&peer=h&ros=humble&name=eye");
  EXPECT_EQ(node.interface, "lo");
  EXPECT_EQ(node.name, "eye");
  EXPECT_EQ(node.peers, std::vector<std::string>{"h"});
  EXPECT_TRUE(node.before_iron);
}

TEST(DdsSensorAddress, LinkInAnotherDomain_IsAnotherNode) {
  const DdsNodeAddress node =
      SensorNode(ParseDdsSensorAddress("dds:domain=1&depth=/a&name=eye"), "dds:domain=2&name=arm");
  EXPECT_EQ(node.domain, 1U);
  EXPECT_EQ(node.name, "eye");
}

TEST(DdsSensorAddress, OneNodeSaidToBeTwo_IsRefusedByTheOption) {
  for (const Wrong& wrong : std::to_array<Wrong>(
           {{"name=arm", "name="}, {"interface=eth0", "interface="}, {"peer=k", "peer="}})) {
    const std::string said = RefusalOf([&] {
      (void)SensorNode(ParseDdsSensorAddress("dds:depth=/a&name=eye&interface=lo&peer=h"),
                       std::string("dds:") + wrong.uri);
    });
    EXPECT_NE(said.find(wrong.said), std::string::npos) << said;
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
