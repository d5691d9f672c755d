// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/udp_link.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <cstring>
#include <memory>
#include <optional>
#include <vector>

#include "byte_text.h"
#include "eventually.h"

namespace disflow::posix::testing {
namespace {

/// The far end: a bound socket on the loopback.
class Peer {
 public:
  /// @param port 0 = any free one.
  explicit Peer(std::uint16_t port = 0) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    own_.sin_family = AF_INET;
    own_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    own_.sin_port = htons(port);
    EXPECT_EQ(::bind(socket_.get(), reinterpret_cast<sockaddr*>(&own_), sizeof(own_)), 0);
    socklen_t size = sizeof(own_);
    EXPECT_EQ(::getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&own_), &size), 0);
  }

  [[nodiscard]] std::uint16_t port() const { return ntohs(own_.sin_port); }

  /// One datagram, "(none)" if none comes.
  std::string Read() {
    pollfd waiting{socket_.get(), POLLIN, 0};
    if (::poll(&waiting, 1, test::kPatience_ms) != 1) return "(none)";
    std::string text(2048, '\0');
    socklen_t size = sizeof(sender_);
    const ssize_t received = ::recvfrom(socket_.get(), text.data(), text.size(), 0,
                                        reinterpret_cast<sockaddr*>(&sender_), &size);
    text.resize(received > 0 ? static_cast<std::size_t>(received) : 0);
    return text;
  }
  /// Port of the last datagram's sender.
  [[nodiscard]] std::uint16_t sender_port() const { return ntohs(sender_.sin_port); }

  [[nodiscard]] bool Reply(std::string_view text) {
    return ::sendto(socket_.get(), text.data(), text.size(), 0,
                    reinterpret_cast<sockaddr*>(&sender_),
                    sizeof(sender_)) == static_cast<ssize_t>(text.size());
  }

 private:
  FileDescriptor socket_;
  sockaddr_in own_{};
  sockaddr_in sender_{};
};

std::uint16_t FreePort() { return Peer().port(); }

hal::LinkAddress AddressOf(const std::string& uri) {
  hal::LinkAddress address;
  const hal::Fault fault = hal::ParseLinkAddress(uri, address);
  EXPECT_TRUE(fault.ok()) << fault.message;
  return address;
}

std::string Uri(std::uint16_t port, const std::string& rest = "") {
  return "udp://127.0.0.1:" + std::to_string(port) + rest;
}

TEST(UdpLink, EveryMessage_IsOneDatagram) {
  Peer peer;
  UdpLink link(AddressOf(Uri(peer.port())));
  ASSERT_TRUE(link.Open().ok());
  ASSERT_TRUE(link.Send(BytesOf("first")).ok());
  ASSERT_TRUE(link.Send(BytesOf("second")).ok());
  EXPECT_EQ(peer.Read(), "first");
  EXPECT_EQ(peer.Read(), "second");
  EXPECT_EQ(link.counters().sent_messages, 2U);
  EXPECT_EQ(link.counters().sent_bytes, 11U);
}

TEST(UdpLink, Name_IsTheAddressAsWritten) {
  EXPECT_STREQ(UdpLink(AddressOf("udp://ground:14550")).name(), "udp://ground:14550");
  EXPECT_STREQ(UdpLink(AddressOf("udp://[::1]:14550")).name(), "udp://[::1]:14550");
}

TEST(UdpLink, AnswerOfThePeer_IsReceived) {
  Peer peer;
  UdpLink link(AddressOf(Uri(peer.port())));
  ASSERT_TRUE(link.Open().ok());
  EXPECT_EQ(ReceivedText(link), "");
  ASSERT_TRUE(link.Send(BytesOf("hello")).ok());
  ASSERT_EQ(peer.Read(), "hello");
  ASSERT_TRUE(peer.Reply("answer"));
  EXPECT_EQ(ReceivedText(link), "answer");
  EXPECT_EQ(link.counters().received_bytes, 6U);
}

TEST(UdpLink, DatagramsThatWait_AreTakenAtOnceInTheirOrder) {
  Peer peer;
  UdpLink link(AddressOf(Uri(peer.port())));
  ASSERT_TRUE(link.Open().ok());
  ASSERT_TRUE(link.Send(BytesOf("hello")).ok());
  ASSERT_EQ(peer.Read(), "hello");
  std::string expected;
  for (int i = 0; i < 100; ++i) {
    // Every third without a byte: it must not look like the end.
    const std::string text = i % 3 == 0 ? "" : std::to_string(i) + ";";
    ASSERT_TRUE(peer.Reply(text));
    expected += text;
  }
  std::vector<std::byte> buffer(64 * UdpLink::kMaxDatagramSize);
  std::string text;
  int calls = 0;
  for (;; ++calls) {
    const auto size = link.Receive(buffer);
    ASSERT_TRUE(size.ok());
    if (size.value == 0) break;
    text.append(reinterpret_cast<const char*>(buffer.data()), size.value);
  }
  EXPECT_EQ(text, expected);
  EXPECT_EQ(calls, 2);
}

TEST(UdpLink, DatagramLongerThanItsRoom_LosesItsTailAndNotTheNext) {
  Peer peer;
  UdpLink link(AddressOf(Uri(peer.port())));
  ASSERT_TRUE(link.Open().ok());
  ASSERT_TRUE(link.Send(BytesOf("hello")).ok());
  ASSERT_EQ(peer.Read(), "hello");
  ASSERT_TRUE(peer.Reply(std::string(UdpLink::kMaxDatagramSize + 500, 'x')));
  ASSERT_TRUE(peer.Reply("next"));
  EXPECT_EQ(ReceivedText(link), std::string(UdpLink::kMaxDatagramSize, 'x') + "next");
}

TEST(UdpLink, RefusalOfThePeer_DoesNotHideWhatWaits) {
  std::uint16_t port = 0;
  std::optional<Peer> peer(std::in_place);
  port = peer->port();
  UdpLink link(AddressOf(Uri(port)));
  ASSERT_TRUE(link.Open().ok());
  ASSERT_TRUE(link.Send(BytesOf("hello")).ok());
  ASSERT_EQ(peer->Read(), "hello");
  ASSERT_TRUE(peer->Reply("answer"));
  peer.reset();
  ASSERT_TRUE(link.Send(BytesOf("nobody is there")).ok());
  EXPECT_EQ(ReceivedText(link), "answer");
}

TEST(UdpLink, NameWithSeveralAddresses_PrefersIpv4) {
  Peer peer;
  UdpLink link(AddressOf("udp://localhost:" + std::to_string(peer.port())));
  ASSERT_TRUE(link.Open().ok());
  ASSERT_TRUE(link.Send(BytesOf("x")).ok());
  EXPECT_EQ(peer.Read(), "x");
}

TEST(UdpLink, BindPort_IsTheSendersPort) {
  Peer peer;
  const std::uint16_t own_port = FreePort();
  UdpLink link(AddressOf(Uri(peer.port(), "?bind=" + std::to_string(own_port))));
  ASSERT_TRUE(link.Open().ok());
  ASSERT_TRUE(link.Send(BytesOf("x")).ok());
  ASSERT_EQ(peer.Read(), "x");
  EXPECT_EQ(peer.sender_port(), own_port);
}

TEST(UdpLink, BindPortInUse_IsBusyAndNamesThePort) {
  Peer peer;
  const Peer other;
  UdpLink link(AddressOf(Uri(peer.port(), "?bind=" + std::to_string(other.port()))));
  const hal::Fault fault = link.Open();
  EXPECT_EQ(fault.status, Status::kBusy);
  EXPECT_NE(std::strstr(fault.message, std::to_string(other.port()).c_str()), nullptr)
      << fault.message;
  EXPECT_EQ(link.Send(BytesOf("x")).status, Status::kNotOpen);
}

TEST(UdpLink, MissingPeer_IsNoErrorButCounted) {
  UdpLink link(AddressOf(Uri(FreePort())));
  ASSERT_TRUE(link.Open().ok());
  for (int i = 0; i < 10; ++i) {
    const hal::Fault fault = link.Send(BytesOf("x"));
    EXPECT_TRUE(fault.ok()) << fault.message;
  }
  EXPECT_GT(link.counters().refused_messages, 0U);
  EXPECT_EQ(link.counters().dropped_messages, 0U);
  std::array<std::byte, 8> buffer{};
  EXPECT_TRUE(link.Receive(buffer).ok());
}

TEST(UdpLink, PeerThatComesLate_GetsTheVeryNextMessage) {
  const std::uint16_t port = FreePort();
  UdpLink link(AddressOf(Uri(port)));
  ASSERT_TRUE(link.Open().ok());
  ASSERT_TRUE(link.Send(BytesOf("lost")).ok());
  Peer peer(port);
  ASSERT_TRUE(link.Send(BytesOf("arrives")).ok());
  EXPECT_EQ(peer.Read(), "arrives");
}

TEST(UdpLink, UnknownHost_IsNotFoundAndNamed) {
  // Two dots in a row are no name, so no name server is asked.
  UdpLink link(AddressOf("udp://no..host:14550"));
  const hal::Fault fault = link.Open();
  EXPECT_EQ(fault.status, Status::kNotFound);
  EXPECT_NE(std::strstr(fault.message, "no..host"), nullptr) << fault.message;
}

TEST(UdpLink, MessageLongerThanADatagram_IsAnErrorAndDropped) {
  Peer peer;
  UdpLink link(AddressOf(Uri(peer.port())));
  ASSERT_TRUE(link.Open().ok());
  EXPECT_EQ(link.Send(BytesOf(std::string(70000, 'x'))).status, Status::kIoError);
  EXPECT_EQ(link.counters().dropped_messages, 1U);
  ASSERT_TRUE(link.Send(BytesOf("still works")).ok());
  EXPECT_EQ(peer.Read(), "still works");
}

TEST(UdpLink, ClosedLink_RefusesWorkAndOpensAgain) {
  Peer peer;
  UdpLink link(AddressOf(Uri(peer.port())));
  std::array<std::byte, 8> buffer{};
  EXPECT_EQ(link.Send(BytesOf("x")).status, Status::kNotOpen);
  EXPECT_EQ(link.Receive(buffer).status, Status::kNotOpen);
  ASSERT_TRUE(link.Open().ok());
  ASSERT_TRUE(link.Open().ok());
  link.Close();
  link.Close();
  EXPECT_EQ(link.Send(BytesOf("x")).status, Status::kNotOpen);
  ASSERT_TRUE(link.Open().ok());
  ASSERT_TRUE(link.Send(BytesOf("again")).ok());
  EXPECT_EQ(peer.Read(), "again");
}

TEST(UdpLink, Ipv6Loopback_Works) {
  const FileDescriptor peer(::socket(AF_INET6, SOCK_DGRAM, 0));
  sockaddr_in6 own{};
  own.sin6_family = AF_INET6;
  own.sin6_addr = in6addr_loopback;
  socklen_t size = sizeof(own);
  if (!peer.is_open() || ::bind(peer.get(), reinterpret_cast<sockaddr*>(&own), sizeof(own)) != 0 ||
      ::getsockname(peer.get(), reinterpret_cast<sockaddr*>(&own), &size) != 0) {
    GTEST_SKIP() << "this machine has no IPv6 loopback";
  }
  UdpLink link(AddressOf("udp://[::1]:" + std::to_string(ntohs(own.sin6_port))));
  const hal::Fault fault = link.Open();
  ASSERT_TRUE(fault.ok()) << fault.message;
  ASSERT_TRUE(link.Send(BytesOf("six")).ok());
  pollfd waiting{peer.get(), POLLIN, 0};
  ASSERT_EQ(::poll(&waiting, 1, test::kPatience_ms), 1);
  char text[8] = {};
  EXPECT_EQ(::recv(peer.get(), text, sizeof(text), 0), 3);
  EXPECT_STREQ(text, "six");
}

}  // namespace
}  // namespace disflow::posix::testing
