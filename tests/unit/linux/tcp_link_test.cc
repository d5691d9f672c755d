// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/tcp_link.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <cstring>
#include <vector>

#include "byte_text.h"
#include "eventually.h"

namespace disflow::posix::testing {
namespace {

sockaddr_in Loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  return address;
}

/// A listening socket on a port of the loopback.
class Server {
 public:
  /// @param port 0 = any free one.
  explicit Server(std::uint16_t port = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    const int yes = 1;
    EXPECT_EQ(::setsockopt(socket_.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes)), 0);
    sockaddr_in own = Loopback(port);
    auto* const generic = reinterpret_cast<sockaddr*>(&own);
    EXPECT_EQ(::bind(socket_.get(), generic, sizeof(own)), 0);
    EXPECT_EQ(::listen(socket_.get(), 4), 0);
    socklen_t size = sizeof(own);
    EXPECT_EQ(::getsockname(socket_.get(), generic, &size), 0);
    port_ = ntohs(own.sin_port);
  }
  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] FileDescriptor Accept() const {
    pollfd waiting{socket_.get(), POLLIN, 0};
    if (::poll(&waiting, 1, test::kPatience_ms) != 1) return {};
    return FileDescriptor(::accept(socket_.get(), nullptr, nullptr));
  }

 private:
  FileDescriptor socket_;
  std::uint16_t port_ = 0;
};

std::uint16_t FreePort() { return Server().port(); }

FileDescriptor ConnectTo(std::uint16_t port) {
  FileDescriptor fd(::socket(AF_INET, SOCK_STREAM, 0));
  const sockaddr_in address = Loopback(port);
  const auto* const generic = reinterpret_cast<const sockaddr*>(&address);
  if (::connect(fd.get(), generic, sizeof(address)) != 0) return {};
  return fd;
}

/// So many bytes, fewer at the end of the stream.
std::string Read(const FileDescriptor& fd, std::size_t size) {
  std::string text;
  while (text.size() < size) {
    pollfd waiting{fd.get(), POLLIN, 0};
    if (::poll(&waiting, 1, test::kPatience_ms) != 1) break;
    char buffer[4096];
    const ssize_t got = ::recv(fd.get(), buffer, std::min(sizeof(buffer), size - text.size()), 0);
    if (got <= 0) break;
    text.append(buffer, static_cast<std::size_t>(got));
  }
  return text;
}

hal::LinkAddress AddressOf(std::uint16_t port, const std::string& options = "") {
  hal::LinkAddress address;
  const hal::Fault fault =
      hal::ParseLinkAddress("tcp://127.0.0.1:" + std::to_string(port) + options, address);
  EXPECT_TRUE(fault.ok()) << fault.message;
  return address;
}

/// Sends until something gets through.
bool EventuallySent(TcpLink& link, std::string_view text) {
  return test::Eventually([&] {
    const std::uint32_t before = link.counters().sent_messages;
    EXPECT_TRUE(link.Send(BytesOf(text)).ok());
    return link.counters().sent_messages > before;
  });
}

TEST(TcpLink, Client_CarriesBytesBothWays) {
  const Server server;
  TcpLink link(AddressOf(server.port()));
  ASSERT_TRUE(link.Open().ok());
  EXPECT_STREQ(link.name(), ("tcp://127.0.0.1:" + std::to_string(server.port())).c_str());
  const FileDescriptor peer = server.Accept();
  ASSERT_TRUE(peer.is_open());
  ASSERT_TRUE(EventuallySent(link, "pose"));
  EXPECT_EQ(Read(peer, 4), "pose");
  ASSERT_EQ(::send(peer.get(), "question", 8, 0), 8);
  std::string received;
  EXPECT_TRUE(test::Eventually([&] { return (received += ReceivedText(link)).size() == 8; }));
  EXPECT_EQ(received, "question");
  EXPECT_EQ(link.counters().received_bytes, 8U);
}

TEST(TcpLink, ServerThatIsNotThereYet_IsNoErrorAndFoundLater) {
  const std::uint16_t port = FreePort();
  TcpLink link(AddressOf(port));
  ASSERT_TRUE(link.Open().ok());
  EXPECT_TRUE(link.Send(BytesOf("lost")).ok());
  EXPECT_TRUE(test::Eventually([&] {
    EXPECT_TRUE(link.Send(BytesOf("lost")).ok());
    return link.counters().refused_messages > 1;
  }));
  const Server server(port);
  ASSERT_TRUE(EventuallySent(link, "here"));
  EXPECT_EQ(Read(server.Accept(), 4), "here");
  EXPECT_EQ(link.counters().reconnects, 0U);
}

TEST(TcpLink, ServerThatGoes_IsFoundAgain) {
  const std::uint16_t port = FreePort();
  TcpLink link(AddressOf(port));
  {
    const Server server(port);
    ASSERT_TRUE(link.Open().ok());
    const FileDescriptor peer = server.Accept();
    ASSERT_TRUE(EventuallySent(link, "one"));
  }
  EXPECT_TRUE(test::Eventually([&] {
    EXPECT_TRUE(link.Send(BytesOf("lost")).ok());
    return link.counters().refused_messages > 0;
  }));
  const Server again(port);
  ASSERT_TRUE(EventuallySent(link, "two"));
  EXPECT_EQ(Read(again.Accept(), 3), "two");
  EXPECT_EQ(link.counters().reconnects, 1U);
}

TEST(TcpLink, WhoConnects_IsServedAloneUntilItGoes) {
  const std::uint16_t port = FreePort();
  TcpLink link(AddressOf(port, "?listen=yes"));
  ASSERT_TRUE(link.Open().ok());
  EXPECT_TRUE(link.Send(BytesOf("nobody")).ok());
  EXPECT_EQ(link.counters().refused_messages, 1U);
  FileDescriptor first = ConnectTo(port);
  ASSERT_TRUE(first.is_open());
  ASSERT_TRUE(EventuallySent(link, "first"));
  EXPECT_EQ(Read(first, 5), "first");
  const FileDescriptor second = ConnectTo(port);
  ASSERT_TRUE(second.is_open());
  ASSERT_TRUE(EventuallySent(link, "more"));
  // It is turned away.
  EXPECT_EQ(Read(second, 1), "");
  EXPECT_EQ(Read(first, 4), "more");
  first.Reset();
  EXPECT_TRUE(test::Eventually([&] {
    EXPECT_TRUE(link.Send(BytesOf("gone")).ok());
    return link.counters().refused_messages > 1;
  }));
  const FileDescriptor third = ConnectTo(port);
  ASSERT_TRUE(EventuallySent(link, "third"));
  EXPECT_EQ(Read(third, 5), "third");
  EXPECT_EQ(link.counters().reconnects, 1U);
}

TEST(TcpLink, PeerThatReadsNothing_LosesWholeMessagesAndNeverStalls) {
  const std::uint16_t port = FreePort();
  TcpLink link(AddressOf(port, "?listen=yes"));
  ASSERT_TRUE(link.Open().ok());
  const FileDescriptor peer = ConnectTo(port);
  // Each a letter, so that a part of one would show.
  constexpr std::size_t kSize = 251;
  // No longer than it takes: the kernel repeats what a full receiver threw away at intervals as
  // long as it has been full, and a busy machine takes its time for each message.
  constexpr std::uint32_t kMost = 60'000;
  constexpr std::uint32_t kRefused = 500;
  std::uint32_t refused = 0;
  std::uint32_t tried = 0;
  for (; tried < kMost && refused < kRefused; ++tried) {
    const std::string message(kSize, static_cast<char>('a' + tried % 26));
    const Status status = link.Send(BytesOf(message)).status;
    ASSERT_TRUE(status == Status::kOk || status == Status::kWouldBlock);
    if (status == Status::kWouldBlock) ++refused;
  }
  const hal::LinkCounters counters = link.counters();
  ASSERT_GT(counters.dropped_messages, 0U);
  EXPECT_EQ(counters.dropped_messages, refused);
  EXPECT_EQ(counters.sent_messages + counters.dropped_messages + counters.refused_messages, tried);
  std::string all;
  EXPECT_TRUE(test::Eventually([&] {
    char buffer[65536];
    // What waits of the last message goes out by the way.
    (void)ReceivedText(link);
    const ssize_t got = ::recv(peer.get(), buffer, sizeof(buffer), MSG_DONTWAIT);
    if (got > 0) all.append(buffer, static_cast<std::size_t>(got));
    return all.size() == counters.sent_messages * kSize;
  }));
  for (std::size_t at = 0; at + kSize <= all.size(); at += kSize) {
    ASSERT_EQ(all.substr(at, kSize), std::string(kSize, all[at])) << at;
  }
}

TEST(TcpLink, PortInUse_IsSaid) {
  const Server server;
  TcpLink link(AddressOf(server.port(), "?listen=yes"));
  const hal::Fault fault = link.Open();
  EXPECT_EQ(fault.status, Status::kBusy);
  EXPECT_NE(std::string(fault.message).find("in use"), std::string::npos);
}

TEST(TcpLink, HostThatDoesNotExist_IsSaidWithItsName) {
  hal::LinkAddress address;
  ASSERT_TRUE(hal::ParseLinkAddress("tcp://no-such-host.invalid:5760", address).ok());
  const hal::Fault fault = TcpLink(address).Open();
  EXPECT_EQ(fault.status, Status::kNotFound);
  EXPECT_NE(std::string(fault.message).find("no-such-host.invalid"), std::string::npos);
}

TEST(TcpLink, NotOpen_SendsAndReceivesNothing) {
  TcpLink link(AddressOf(1));
  EXPECT_EQ(link.Send(BytesOf("x")).status, Status::kNotOpen);
  std::byte room[4];
  EXPECT_EQ(link.Receive(room).status, Status::kNotOpen);
  EXPECT_EQ(link.fd(), -1);
}

TEST(TcpLink, Descriptor_ShowsInputWhenSomethingCanBeTaken) {
  const std::uint16_t port = FreePort();
  TcpLink link(AddressOf(port, "?listen=yes"));
  ASSERT_TRUE(link.Open().ok());
  const auto shows_input = [&] {
    pollfd waiting{link.fd(), POLLIN, 0};
    return ::poll(&waiting, 1, test::kPatience_ms) == 1;
  };
  const FileDescriptor peer = ConnectTo(port);
  ASSERT_TRUE(shows_input());
  EXPECT_EQ(ReceivedText(link), "");
  ASSERT_EQ(::send(peer.get(), "a", 1, 0), 1);
  ASSERT_TRUE(shows_input());
  EXPECT_EQ(ReceivedText(link), "a");
}

}  // namespace
}  // namespace disflow::posix::testing
