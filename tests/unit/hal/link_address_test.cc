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

TEST(LinkAddress, LongestNames_Fit) {
  const std::string host(LinkAddress::kMaxHostLength, 'h');
  EXPECT_EQ(Parsed("udp://" + host + ":1").host, host);
  const std::string device = std::string("/").append(LinkAddress::kMaxDeviceLength - 1, 'd');
  EXPECT_EQ(Parsed("serial://" + device).device, device);
}

struct BadUri {
  std::string uri;
  const char* says;
};

class BadLinkAddress : public ::testing::TestWithParam<BadUri> {};

TEST_P(BadLinkAddress, IsRefusedWithTheReasonAndChangesNothing) {
  LinkAddress address;
  address.port = 4711;
  const Fault fault = ParseLinkAddress(GetParam().uri, address);
  EXPECT_EQ(fault.status, Status::kInvalidUri);
  EXPECT_NE(std::string(fault.message).find(GetParam().says), std::string::npos) << fault.message;
  EXPECT_EQ(address.port, 4711);
}

INSTANTIATE_TEST_SUITE_P(
    LinkAddress, BadLinkAddress,
    ::testing::Values(
        BadUri{"", "unknown kind"}, BadUri{"tcp://a:1", "unknown kind"},
        BadUri{"UDP://a:1", "unknown kind"}, BadUri{"udp://", "port is missing"},
        BadUri{"udp://host", "port is missing"}, BadUri{"udp://:14550", "host is missing"},
        BadUri{"udp://[]:14550", "host is missing"}, BadUri{"udp://::1:14550", "brackets"},
        BadUri{"udp://a:", "port is not"}, BadUri{"udp://a:0", "port is not"},
        BadUri{"udp://a:65536", "port is not"}, BadUri{"udp://a:-1", "port is not"},
        BadUri{"udp://a:12x", "port is not"}, BadUri{"udp://a:99999999999999", "port is not"},
        BadUri{"udp://a:1?bind=", "?bind=PORT"}, BadUri{"udp://a:1?bind=70000", "?bind=PORT"},
        BadUri{"udp://a:1?baud=1", "?bind=PORT"}, BadUri{"udp://a:1?bind=1&bind=2", "?bind=PORT"},
        BadUri{"udp://" + std::string(254, 'h') + ":1", "too long"},
        BadUri{std::string("udp://a\0b:1", 11), "host"}, BadUri{"serial://", "absolute path"},
        BadUri{"serial://ttyS0", "absolute path"},
        BadUri{"serial:///" + std::string(200, 'd'), "absolute path"},
        BadUri{"serial:///dev/a?baud=0", "?baud=RATE"},
        BadUri{"serial:///dev/a?baud=4000001", "?baud=RATE"},
        BadUri{"serial:///dev/a?speed=9600", "?baud=RATE"},
        BadUri{"serial:///dev/a?baud=9600 ", "?baud=RATE"}));

}  // namespace
}  // namespace disflow::hal
