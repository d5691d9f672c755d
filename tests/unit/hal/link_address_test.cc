// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/link_address.h"

#include <gtest/gtest.h>

#include <string>

namespace disflow::hal {
namespace {

LinkAddress Parsed(std::string_view uri) {
  LinkAddress address;
  const Fault fault = ParseLinkAddress(uri, address);
  EXPECT_TRUE(fault.ok()) << fault.message;
  return address;
}

TEST(LinkAddress, Udp_HasHostAndPort) {
  const LinkAddress address = Parsed("udp://ground.local:14550");
  EXPECT_EQ(address.kind, LinkAddress::Kind::kUdp);
  EXPECT_STREQ(address.host, "ground.local");
  EXPECT_EQ(address.port, 14550);
  EXPECT_EQ(address.bind_port, 0);
}

TEST(LinkAddress, UdpBind_IsTheOwnPort) {
  EXPECT_EQ(Parsed("udp://127.0.0.1:1?bind=65535").bind_port, 65535);
}

TEST(LinkAddress, Ipv6_LosesItsBrackets) {
  const LinkAddress address = Parsed("udp://[fe80::1]:14550");
  EXPECT_STREQ(address.host, "fe80::1");
  EXPECT_EQ(address.port, 14550);
}

TEST(LinkAddress, Serial_HasDeviceAndBaud) {
  const LinkAddress address = Parsed("serial:///dev/ttyUSB0?baud=115200");
  EXPECT_EQ(address.kind, LinkAddress::Kind::kSerial);
  EXPECT_STREQ(address.device, "/dev/ttyUSB0");
  EXPECT_EQ(address.baud, 115200U);
}

TEST(LinkAddress, SerialWithoutBaud_TakesTheDefault) {
  EXPECT_EQ(Parsed("serial:///dev/ttyS0").baud, LinkAddress::kDefaultBaud);
}

TEST(LinkAddress, KeyFile_StandsAloneOrBesideTheOtherOption) {
  EXPECT_STREQ(Parsed("udp://a:1").key_file, "");
  EXPECT_STREQ(Parsed("udp://a:1?key=/etc/k").key_file, "/etc/k");
  EXPECT_STREQ(Parsed("serial:///dev/a?key=k=2?").key_file, "k=2?");
  for (const char* const uri : {"udp://a:1?bind=7&key=k", "udp://a:1?key=k&bind=7"}) {
    EXPECT_STREQ(Parsed(uri).key_file, "k");
    EXPECT_EQ(Parsed(uri).bind_port, 7);
  }
  EXPECT_EQ(Parsed("serial:///dev/a?key=k&baud=9600").baud, 9600U);
  EXPECT_EQ(Parsed("serial:///dev/a?key=k").baud, LinkAddress::kDefaultBaud);
  EXPECT_FALSE(Parsed("serial:///dev/a?key=k").may_choose);
  EXPECT_TRUE(Parsed("serial:///dev/a?key=k&choose=yes").may_choose);
  EXPECT_TRUE(Parsed("udp://a:1?choose=yes&bind=7").may_choose);
}

TEST(LinkAddress, Tcp_ConnectsOrListens) {
  const LinkAddress client = Parsed("tcp://[::1]:5760?key=k");
  EXPECT_EQ(client.kind, LinkAddress::Kind::kTcp);
  EXPECT_STREQ(client.host, "::1");
  EXPECT_EQ(client.port, 5760);
  EXPECT_FALSE(client.listens);
  EXPECT_STREQ(client.key_file, "k");
  EXPECT_TRUE(Parsed("tcp://0.0.0.0:5760?choose=yes&listen=yes").listens);
}

TEST(LinkAddress, StampsAndMessage_AreThoseOfTheImagesAndOdometryUnlessSaid) {
  using Stamps = LinkAddress::Stamps;
  using Pose = LinkAddress::Pose;
  EXPECT_EQ(Parsed("udp://a:1").stamps, Stamps::kCapture);
  EXPECT_EQ(Parsed("udp://a:1?stamps=monotonic").stamps, Stamps::kMonotonic);
  EXPECT_EQ(Parsed("tcp://a:1?stamps=epoch").stamps, Stamps::kEpoch);
  EXPECT_EQ(Parsed("serial:///dev/a?baud=9600&stamps=autopilot").stamps, Stamps::kAutopilot);
  EXPECT_EQ(Parsed("udp://a:1").pose, Pose::kOdometry);
  EXPECT_EQ(Parsed("udp://a:1?send=landing_target").pose, Pose::kLandingTarget);
  EXPECT_EQ(Parsed("udp://a:1?bind=2&send=follow_target&stamps=epoch").pose, Pose::kFollowTarget);
}

TEST(LinkAddress, LongestNames_Fit) {
  const std::string host(LinkAddress::kMaxHostLength, 'h');
  EXPECT_EQ(Parsed("udp://" + host + ":1").host, host);
  const std::string key(LinkAddress::kMaxKeyFileLength, 'k');
  EXPECT_EQ(Parsed("udp://a:1?key=" + key).key_file, key);
  const std::string device = std::string("/").append(LinkAddress::kMaxDeviceLength - 1, 'd');
  EXPECT_EQ(Parsed("serial://" + device).device, device);
}

struct BadUri {
  std::string uri;
  const char* says;
};

TEST(LinkAddress, BadOne_IsRefusedWithTheReasonAndChangesNothing) {
  const BadUri bad_uris[] = {{"", "unknown kind"},
                             {"tls://a:1", "unknown kind"},
                             {"UDP://a:1", "unknown kind"},
                             {"udp://", "port is missing"},
                             {"udp://host", "port is missing"},
                             {"udp://:14550", "host is missing"},
                             {"udp://[]:14550", "host is missing"},
                             {"udp://::1:14550", "brackets"},
                             {"udp://a:", "port is not"},
                             {"udp://a:0", "port is not"},
                             {"udp://a:65536", "port is not"},
                             {"udp://a:-1", "port is not"},
                             {"udp://a:12x", "port is not"},
                             {"udp://a:99999999999999", "port is not"},
                             {"udp://a:1?bind=", "bind=PORT"},
                             {"udp://a:1?bind=70000", "bind=PORT"},
                             {"udp://a:1?baud=1", "bind=PORT"},
                             {"udp://a:1?bind=1&bind=2", "bind=PORT"},
                             {"udp://a:1?key=", "key=FILE"},
                             {"udp://a:1?key=a&key=b", "key=FILE"},
                             {"udp://a:1?choose=no", "choose=yes"},
                             {"udp://a:1?choose=yes&choose=yes", "choose=yes"},
                             {"serial:///dev/a?choose", "choose=yes"},
                             {"udp://a:1?bind=1&", "key=FILE"},
                             {"udp://a:1?&key=a", "key=FILE"},
                             {"udp://a:1?key=" + std::string(256, 'k'), "key=FILE"},
                             {std::string("udp://a:1?key=a\0b", 17), "key=FILE"},
                             {"serial:///dev/a?key=a&key=b", "key=FILE"},
                             {"serial:///dev/a?baud=9600&baud=9600", "baud=RATE"},
                             {"udp://" + std::string(254, 'h') + ":1", "too long"},
                             {std::string("udp://a\0b:1", 11), "host"},
                             {"tcp://a:1?bind=2", "listen=yes"},
                             {"tcp://a:1?listen=no", "listen=yes"},
                             {"tcp://a:1?listen=yes&listen=yes", "listen=yes"},
                             {"udp://a:1?listen=yes", "bind=PORT"},
                             {"udp://a:1?stamps=utc", "stamps=monotonic|epoch|autopilot"},
                             {"udp://a:1?stamps=epoch&stamps=epoch", "stamps="},
                             {"udp://a:1?send=odometry", "send=landing_target|follow_target"},
                             {"serial://", "absolute path"},
                             {"serial://ttyS0", "absolute path"},
                             {"serial:///" + std::string(200, 'd'), "absolute path"},
                             {"serial:///dev/a?baud=0", "baud=RATE"},
                             {"serial:///dev/a?baud=4000001", "baud=RATE"},
                             {"serial:///dev/a?speed=9600", "baud=RATE"},
                             {"serial:///dev/a?baud=9600 ", "baud=RATE"}};
  for (const BadUri& bad : bad_uris) {
    LinkAddress address;
    address.port = 4711;
    const Fault fault = ParseLinkAddress(bad.uri, address);
    EXPECT_EQ(fault.status, Status::kInvalidUri) << bad.uri;
    EXPECT_NE(std::string(fault.message).find(bad.says), std::string::npos) << fault.message;
    EXPECT_EQ(address.port, 4711) << bad.uri;
  }
}

}  // namespace
}  // namespace disflow::hal
