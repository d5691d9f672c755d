// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/view/web_address.h"

#include <gtest/gtest.h>

namespace disflow::posix {
namespace {

TEST(WebAddress, PortAlone_IsThisMachinesOnly) {
  for (const char* text : {"8080", ":8080", "localhost:8080", "127.0.0.1:8080"}) {
    WebAddress address;
    ASSERT_TRUE(ParseWebAddress(text, address).ok()) << text;
    EXPECT_EQ(address.host, "127.0.0.1");
    EXPECT_EQ(address.port, 8080);
    EXPECT_TRUE(address.is_loopback);
    EXPECT_EQ(address.Url(address.port), "http://127.0.0.1:8080/");
  }
}

TEST(WebAddress, AddressesThatOthersReach_AreNoLoopback) {
  for (const char* text :
       {"0.0.0.0:80", "192.168.1.5:80", "128.0.0.1:80", "[::]:80", "[fe80::1]:80"}) {
    WebAddress address;
    ASSERT_TRUE(ParseWebAddress(text, address).ok()) << text;
    EXPECT_FALSE(address.is_loopback) << text;
  }
  WebAddress address;
  ASSERT_TRUE(ParseWebAddress("[::1]:80", address).ok());
  EXPECT_TRUE(address.is_loopback);
  EXPECT_EQ(address.Url(80), "http://[::1]:80/");
}

TEST(WebAddress, ATokenIsGivenUpByNameOnly_AndOnlyOnLoopback) {
  for (const char* text : {":80?token=none", "80?token=none", "[::1]:80?token=none"}) {
    WebAddress address;
    ASSERT_TRUE(ParseWebAddress(text, address).ok()) << text;
    EXPECT_TRUE(address.without_token) << text;
    EXPECT_TRUE(address.is_loopback) << text;
    EXPECT_EQ(address.port, 80) << text;
  }
  WebAddress address;
  ASSERT_TRUE(ParseWebAddress(":80", address).ok());
  EXPECT_FALSE(address.without_token);
  for (const char* text : {"0.0.0.0:80?token=none", "[::]:80?token=none", ":80?token=", ":80?token",
                           ":80?token=None", ":80?token=none?token=none", "?token=none"}) {
    EXPECT_EQ(ParseWebAddress(text, address).status, Status::kInvalidUri) << text;
  }
}

TEST(WebAddress, Rubbish_IsRefusedWithItsText) {
  for (const char* text :
       {"", ":", "x", ":x", ":-1", ":65536", ":80x", "robot:80", "1.2.3:80", "1.2.3.4", "[::1:80",
        "::1:80", "[]:80", "1.2.3.4:80:90", "http://1.2.3.4:80", ": 80"}) {
    WebAddress address;
    const hal::Fault fault = ParseWebAddress(text, address);
    EXPECT_EQ(fault.status, Status::kInvalidUri) << text;
    EXPECT_EQ(std::string(fault.message).find(text), 0U) << fault.message;
  }
}

}  // namespace
}  // namespace disflow::posix
