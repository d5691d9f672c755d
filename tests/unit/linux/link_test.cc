// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/link.h"

#include <gtest/gtest.h>

#include <string>

#include "disflow/posix/socket_link.h"

namespace disflow::posix {
namespace {

TEST(Link, BeforeConfigure_ThereIsNone) { EXPECT_EQ(Link().get(), nullptr); }

TEST(Link, Kind_FollowsTheAddress) {
  Link link;
  ASSERT_TRUE(link.Configure("udp://127.0.0.1:14550").ok());
  ASSERT_NE(link.get(), nullptr);
  EXPECT_STREQ(link.get()->name(), "udp://127.0.0.1:14550");
  ASSERT_TRUE(link.Configure("serial:///dev/ttyS0?baud=115200").ok());
  EXPECT_STREQ(link.get()->name(), "serial:///dev/ttyS0");
  ASSERT_TRUE(link.Configure("tcp://[::1]:5760?stamps=epoch").ok());
  EXPECT_STREQ(link.get()->name(), "tcp://[::1]:5760");
  EXPECT_EQ(link.address().stamps, hal::LinkAddress::Stamps::kEpoch);
  EXPECT_EQ(link.fd(), -1);
}

TEST(Link, BadAddress_LeavesTheOldLink) {
  Link link;
  ASSERT_TRUE(link.Configure("udp://127.0.0.1:14550").ok());
  EXPECT_EQ(link.Configure("udp://127.0.0.1").status, Status::kInvalidUri);
  ASSERT_NE(link.get(), nullptr);
  EXPECT_STREQ(link.get()->name(), "udp://127.0.0.1:14550");
}

TEST(SocketLinkTest, PortThatThereIsNot_IsRefusedAndNotWrapped) {
  for (const char* address :
       {"tcp:127.0.0.1:99999", "tcp:127.0.0.1:0", "tcp:127.0.0.1:-1",
        "tcp:127.0.0.1:", "tcp:127.0.0.1", "tcp::80", "tcp:::1:80", "tcp:127.0.0.1:80?key=x"}) {
    EXPECT_EQ(SocketLink::CheckAddress(address).status, Status::kInvalidUri) << address;
    EXPECT_EQ(SocketLink(address).Open().status, Status::kInvalidUri) << address;
  }
  const hal::Fault fault = SocketLink::CheckAddress("tcp:127.0.0.1:99999");
  EXPECT_NE(std::string(fault.message).find("from 1 to 65535"), std::string::npos) << fault.message;
  for (const char* address : {"tcp:127.0.0.1:65535", "tcp:localhost:1", "tcp:[::1]:80", "unix:a"})
    EXPECT_TRUE(SocketLink::CheckAddress(address).ok()) << address;
}

}  // namespace
}  // namespace disflow::posix
