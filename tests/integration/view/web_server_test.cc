// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/view/web_server.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include "raw_client.h"

namespace disflow {
namespace {

using posix::MessageBoard;
using posix::WebAddress;
using posix::WebAsset;
using posix::WebServer;
using posix::WebServerOptions;

constexpr std::array<std::uint8_t, 4> kContent = {'p', 'a', 'g', 'e'};
constexpr std::array kPage = {WebAsset{"/", "text/html; charset=utf-8", kContent}};
constexpr unsigned char kBinary = 0x82;
constexpr std::string_view kCommand("\x02\x00\x00\x00", 4);
/// 1002
constexpr std::string_view kProtocolError("\x88\x02\x03\xEA", 4);
constexpr std::string_view kLongCommand("\x04\x00\x00\x00 of 14 byte", 14);

class WebServerTest : public testing::Test {
 protected:
  static constexpr int kPatient_s = 60;
  static constexpr int kHurried_s = 1;

  WebServerTest() { board_.Put(0, {'h', 'e', 'l', 'l', 'o'}); }

  /// @param patience_s How long the server waits for a request to be whole. Short where a test
  /// waits for its end, and long where a busy machine must not bring it about.
  void Start(const std::string& token = "", int max_connections = 32, int patience_s = kPatient_s,
             std::function<std::string()> metrics = {}) {
    WebServerOptions options;
    options.metrics = std::move(metrics);
    options.token = token;
    options.max_connections = max_connections;
    options.max_viewers = 3;
    options.request_timeout_s = patience_s;
    options.connection_timeout_s = 2 * patience_s;
    options.ping_after_s = patience_s;
    options.hang_up_after_s = 3 * patience_s;
    server_ = std::make_unique<WebServer>(options, kPage, board_, [this](auto) { ++commands_; });
    const hal::Fault fault = server_->Start();
    ASSERT_TRUE(fault.ok()) << fault.message;
  }

  [[nodiscard]] int port() const { return server_->port(); }
  [[nodiscard]] bool Serves() const { return StatusOf(Get(port(), "/")) == 200; }

  /// What a viewer sees that has sent this after opening its WebSocket.
  /// @param reason Its close frame, if that matters.
  void ExpectHangUp(const std::string& frames, std::string_view reason = "") {
    RawClient client(port());
    client.Send(Upgrade(port()));
    ASSERT_EQ(StatusOf(client.ReadUntil("hello")), 101);
    client.Send(frames);
    if (reason.empty()) {
      EXPECT_TRUE(client.IsHungUpOn());
    } else {
      EXPECT_NE(client.ReadUntil(reason).find(reason), std::string::npos);
    }
    EXPECT_EQ(commands_, 0);
    EXPECT_TRUE(Serves());
  }

  void ExpectFloodIsEnded(const std::string& frame) {
    RawClient client(port());
    client.Send(Upgrade(port()));
    ASSERT_EQ(StatusOf(client.ReadUntil("hello")), 101);
    for (int i = 0; i < 1000; ++i) {
      if (!client.Send(frame)) break;
    }
    EXPECT_TRUE(client.IsHungUpOn());
    EXPECT_LT(commands_, 100);
  }

  MessageBoard board_{2, 4};
  std::atomic<int> commands_ = 0;
  std::unique_ptr<WebServer> server_;
};

TEST_F(WebServerTest, Page_ComesFromMemoryWithHeadersThatBindTheBrowser) {
  Start();
  const std::string answer = Get(port(), "/");
  EXPECT_EQ(StatusOf(answer), 200);
  EXPECT_TRUE(answer.ends_with("\r\n\r\npage")) << answer;
  for (const char* header :
       {"content-security-policy: default-src 'none'; script-src 'self'",
        "x-content-type-options: nosniff", "x-frame-options: DENY", "referrer-policy: no-referrer",
        "cache-control: no-store", "content-encoding: gzip"}) {
    EXPECT_NE(answer.find(header), std::string::npos) << header;
  }
}

TEST_F(WebServerTest, PathsToFiles_ReachNothing) {
  Start();
  for (const char* path :
       {"/etc/passwd", "/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd",
        "/..%2f..%2fetc%2fpasswd", "/./../etc/passwd", "/app.js/../../etc/passwd", "/live",
        "/index.html", "/proc/self/environ", "\\..\\etc", "file:///etc/passwd"}) {
    const std::string answer = Get(port(), path);
    EXPECT_NE(StatusOf(answer), 200) << path;
    EXPECT_EQ(answer.find("root:"), std::string::npos) << path;
  }
  EXPECT_TRUE(Serves());
}

TEST_F(WebServerTest, OtherMethodsAndBodies_AreRefused) {
  Start("", 32, kHurried_s);
  const std::string host = "Host: localhost:" + std::to_string(port()) + "\r\n";
  for (const char* method :
       {"POST", "PUT", "DELETE", "PATCH", "OPTIONS", "HEAD", "CONNECT", "FOO"}) {
    const std::string answer = Ask(port(), std::string(method) + " / HTTP/1.1\r\n" + host + "\r\n");
    EXPECT_TRUE(answer.empty() || StatusOf(answer) >= 400) << method << ": " << answer;
  }
  EXPECT_EQ(StatusOf(Get(port(), "/", "Content-Length: 5\r\n")), 413);
  EXPECT_EQ(StatusOf(Get(port(), "/", "Transfer-Encoding: chunked\r\n")), 413);
  EXPECT_TRUE(Serves());
}

TEST_F(WebServerTest, NoHttpAtAll_EndsTheConnection) {
  Start("", 32, kHurried_s);
  for (const std::string& noise :
       {std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11), std::string(200, '\0'),
        std::string("\r\n\r\n\r\n"), std::string("GET\r\n\r\n"),
        std::string("GET / HTTP/9.9\r\n\r\n"), std::string("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n")}) {
    RawClient client(port());
    client.Send(noise);
    EXPECT_TRUE(client.IsClosedByServer());
  }
  EXPECT_TRUE(Serves());
}

TEST_F(WebServerTest, OversizedHeader_EndsTheConnectionUnanswered) {
  Start("", 32, kHurried_s);
  for (const std::string& header :
       {"X-Long: " + std::string(100'000, 'a') + "\r\n",
        "Cookie: " + std::string(5'000, 'a') + "\r\n", std::string(5'000, 'n') + ": x\r\n"}) {
    EXPECT_NE(StatusOf(Get(port(), "/", header)), 200);
  }
  EXPECT_NE(StatusOf(Get(port(), "/" + std::string(10'000, 'a'))), 200);
  EXPECT_TRUE(Serves());
}

TEST_F(WebServerTest, EndlessHeaders_EndTheConnection) {
  Start("", 32, kHurried_s);
  RawClient client(port());
  client.Send("GET / HTTP/1.1\r\n");
  std::string line = "X-One: " + std::string(60, 'b') + "\r\n";
  int lines = 0;
  while (lines < 100'000 && client.Send(line)) ++lines;
  EXPECT_LT(lines, 100'000);
  EXPECT_TRUE(Serves());
}

TEST_F(WebServerTest, SlowRequests_AreEndedAndKeepNobodyWaiting) {
  Start("", 8, kHurried_s);
  std::vector<std::unique_ptr<RawClient>> slow;
  for (int i = 0; i < 7; ++i) {
    slow.push_back(std::make_unique<RawClient>(port()));
    slow.back()->Send(i == 0 ? "" : "GET / HTTP/1.1\r\nHost: local");
  }
  EXPECT_TRUE(Serves());
  for (const auto& client : slow) EXPECT_TRUE(client->IsClosedByServer());
}

TEST_F(WebServerTest, RequestThatComesByteByByte_IsEndedAsAWhole) {
  Start("", 32, kHurried_s);
  RawClient client(port());
  const std::string request = "GET / HTTP/1.1\r\nX-Slow: " + std::string(500, 'c');
  std::size_t sent = 0;
  while (sent < request.size() && client.Send(request.substr(sent, 1))) {
    ++sent;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_LT(sent, request.size());
  EXPECT_TRUE(Serves());
}

TEST_F(WebServerTest, ConnectionsBeyondTheLimit_AreClosedUntilOthersEnd) {
  Start("", 4, 5);
  std::vector<std::unique_ptr<RawClient>> viewers;
  for (int i = 0; i < 3; ++i) {
    viewers.push_back(std::make_unique<RawClient>(port()));
    viewers.back()->Send(Upgrade(port()));
    ASSERT_EQ(StatusOf(viewers.back()->ReadUntil("hello")), 101);
  }
  RawClient waiting(port());
  waiting.Send("GET / HT");
  // It has been accepted once this one, which came later, is refused.
  EXPECT_FALSE(Serves());
  EXPECT_TRUE(waiting.IsClosedByServer());
  EXPECT_TRUE(Serves());
}

TEST_F(WebServerTest, ViewersBeyondTheLimit_AreToldSo) {
  Start();
  std::vector<std::unique_ptr<RawClient>> viewers;
  for (int i = 0; i < 3; ++i) {
    viewers.push_back(std::make_unique<RawClient>(port()));
    viewers.back()->Send(Upgrade(port()));
    ASSERT_EQ(StatusOf(viewers.back()->ReadUntil("hello")), 101);
  }
  EXPECT_EQ(server_->viewers(), 3);
  EXPECT_EQ(StatusOf(Ask(port(), Upgrade(port()))), 503);
  EXPECT_TRUE(Serves());
}

TEST_F(WebServerTest, OtherSites_GetNothing) {
  Start();
  const std::string own = "http://localhost:" + std::to_string(port());
  EXPECT_EQ(StatusOf(Ask(port(), Upgrade(port(), "Origin: https://example.org\r\n"))), 403);
  EXPECT_EQ(StatusOf(Ask(port(), Upgrade(port(), "Origin: null\r\n"))), 403);
  EXPECT_EQ(StatusOf(Ask(port(), Upgrade(port(), "Origin: " + own + "\r\n"))), 101);
  // A name of theirs that was made to point here.
  for (const char* host :
       {"example.org", "localhost.example.org", "127.0.0.1.example.org", "127.evil"}) {
    EXPECT_EQ(StatusOf(Get(port(), "/", std::string("Host: ") + host + ":80\r\n")), 403) << host;
  }
  EXPECT_EQ(StatusOf(Get(port(), "/", "Host: [::1]:80\r\n")), 200);
}

TEST_F(WebServerTest, OtherUpgrades_AreRefused) {
  Start();
  EXPECT_EQ(StatusOf(Ask(port(), Upgrade(port(), "", "/other"))), 404);
  EXPECT_NE(StatusOf(Ask(port(), Upgrade(port(), "", "/live", "http"))), 101);
  EXPECT_NE(StatusOf(Ask(port(), Upgrade(port(), "", "/live", "chat"))), 101);
  const std::string h2c = Get(
      port(), "/", "Upgrade: h2c\r\nConnection: Upgrade, HTTP2-Settings\r\nHTTP2-Settings: AA\r\n");
  EXPECT_NE(StatusOf(h2c), 101);
  EXPECT_TRUE(Serves());
}

TEST_F(WebServerTest, WithoutTheToken_NothingIsServed) {
  Start("correct-horse");
  const std::string cookie = "disflow_" + std::to_string(port()) + "=";
  EXPECT_EQ(StatusOf(Get(port(), "/")), 401);
  EXPECT_EQ(StatusOf(Get(port(), "/nothing")), 401);
  EXPECT_EQ(StatusOf(Ask(port(), Upgrade(port()))), 401);
  for (const std::string& wrong :
       {std::string("correct-hors"), std::string("correct-horse-"), std::string("x"), std::string(),
        std::string("correct-horsf"), std::string("correct-horsecorrect-horse"),
        std::string(220, 'c')}) {
    EXPECT_EQ(StatusOf(Get(port(), "/?token=" + wrong)), 401) << wrong;
    EXPECT_EQ(StatusOf(Get(port(), "/", "Cookie: " + cookie + wrong + "\r\n")), 401) << wrong;
  }
}

TEST_F(WebServerTest, Metrics_AreServedWholeToPrograms) {
  // More than fits into one piece.
  const std::string text = "# HELP a b\n" + std::string(100'000, 'm') + "\nend\n";
  Start("correct-horse", 32, kPatient_s, [text] { return text; });
  EXPECT_EQ(StatusOf(Get(port(), "/metrics")), 401);
  EXPECT_EQ(StatusOf(Get(port(), "/metrics", "Authorization: Bearer wrong-horse\r\n")), 401);
  EXPECT_EQ(StatusOf(Get(port(), "/metrics", "Authorization: Basic correct-horse\r\n")), 401);
  for (int i = 0; i < 3; ++i) {
    const std::string answer = Get(port(), "/metrics", "Authorization: Bearer correct-horse\r\n");
    EXPECT_EQ(StatusOf(answer), 200);
    EXPECT_NE(answer.find("text/plain; version=0.0.4"), std::string::npos);
    EXPECT_TRUE(answer.ends_with(text));
  }
  EXPECT_TRUE(StatusOf(Get(port(), "/", "Authorization: Bearer correct-horse\r\n")) == 200);
}

TEST_F(WebServerTest, ReaderOfMetricsThatHangsUp_LeavesTheServerServing) {
  Start("", 32, kPatient_s, [] { return std::string(10'000'000, 'm'); });
  for (int i = 0; i < 20; ++i) {
    RawClient client(port());
    client.Send("GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(StatusOf(client.ReadUntil("mmmm")), 200);
  }
  EXPECT_TRUE(Serves());
}

TEST_F(WebServerTest, WithoutMetrics_ThereIsNoSuchPage) {
  Start();
  EXPECT_EQ(StatusOf(Get(port(), "/metrics")), 404);
}

TEST_F(WebServerTest, TokenInTheAddress_BecomesACookieThatOpensAll) {
  Start("correct-horse");
  const std::string answer = Get(port(), "/?token=correct-horse");
  EXPECT_EQ(StatusOf(answer), 303);
  EXPECT_NE(answer.find("location: /\r\n"), std::string::npos) << answer;
  const std::string cookie = "disflow_" + std::to_string(port()) + "=correct-horse";
  EXPECT_NE(answer.find("set-cookie: " + cookie + "; Path=/; HttpOnly; SameSite=Lax\r\n"),
            std::string::npos)
      << answer;
  EXPECT_EQ(StatusOf(Get(port(), "/", "Cookie: a=b; " + cookie + "\r\n")), 200);
  EXPECT_EQ(StatusOf(Ask(port(), Upgrade(port(), "Cookie: " + cookie + "\r\n"))), 101);
}

TEST_F(WebServerTest, Commands_ReachTheProgram) {
  Start();
  RawClient client(port());
  client.Send(Upgrade(port()));
  ASSERT_EQ(StatusOf(client.ReadUntil("hello")), 101);
  client.Send(Frame(kBinary, kCommand));
  client.Send(Frame(kBinary, kLongCommand));
  client.Send(Frame(0x89, "ping"));
  EXPECT_NE(client.ReadUntil("ping").find("ping"), std::string::npos);
  EXPECT_EQ(commands_, 2);
}

TEST_F(WebServerTest, ReservedOpcode_HangsUp) {
  Start();
  ExpectHangUp(Frame(0x83, kCommand));
}
TEST_F(WebServerTest, ReservedBits_HangUp) {
  Start();
  ExpectHangUp(Frame(0xF2, kCommand));
}
TEST_F(WebServerTest, TextInsteadOfBinary_HangsUp) {
  Start();
  ExpectHangUp(Frame(0x81, "abcd"));
}
TEST_F(WebServerTest, FragmentedCommand_HangsUp) {
  Start();
  ExpectHangUp(Frame(0x02, kCommand) + Frame(0x80, kCommand));
}
TEST_F(WebServerTest, CommandOfAnotherSize_HangsUp) {
  Start();
  ExpectHangUp(Frame(kBinary, "abc"));
  ExpectHangUp(Frame(kBinary, "abcde"));
  ExpectHangUp(Frame(kBinary, kLongCommand.substr(1)));
  ExpectHangUp(Frame(kBinary, std::string(100, 'a')));
}
TEST_F(WebServerTest, EndlessFrame_HangsUpAtItsFirstBytes) {
  Start();
  ExpectHangUp(std::string("\x82\xff\x00\x00\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00", 14) +
               std::string(1000, 'a'));
}
TEST_F(WebServerTest, OversizedControlFrame_HangsUp) {
  Start();
  ExpectHangUp(std::string("\x89\xfe\x01\x00\x00\x00\x00\x00", 8) + std::string(256, 'a'));
}

// RFC 6455, 5.1.
TEST_F(WebServerTest, UnmaskedFrames_AreHungUpOnForAProtocolError) {
  Start();
  ExpectHangUp(UnmaskedFrame(kBinary, kCommand), kProtocolError);
  ExpectHangUp(UnmaskedFrame(kBinary, kLongCommand), kProtocolError);
  ExpectHangUp(UnmaskedFrame(kBinary, ""), kProtocolError);
  ExpectHangUp(UnmaskedFrame(0x81, "abcd"), kProtocolError);
  ExpectHangUp(UnmaskedFrame(0x88, ""), kProtocolError);
  ExpectHangUp(UnmaskedFrame(0x89, "ping"), kProtocolError);
  ExpectHangUp(UnmaskedFrame(0x8A, ""), kProtocolError);
  ExpectHangUp(Frame(0x89, "ping") + UnmaskedFrame(kBinary, kCommand), kProtocolError);
}

TEST_F(WebServerTest, FramesAheadOfTheAnswer_GiveNoCommands) {
  Start();
  for (const std::string& frame : {Frame(kBinary, kCommand), UnmaskedFrame(kBinary, kCommand)}) {
    RawClient client(port());
    client.Send(Upgrade(port()) + frame);
    EXPECT_TRUE(client.IsHungUpOn());
  }
  EXPECT_EQ(commands_, 0);
  EXPECT_TRUE(Serves());
}

TEST_F(WebServerTest, CloseFrame_IsAnsweredAndTheConnectionEnds) {
  Start();
  RawClient client(port());
  client.Send(Upgrade(port()));
  ASSERT_EQ(StatusOf(client.ReadUntil("hello")), 101);
  client.Send(Frame(0x88, "\x03\xE8"));
  EXPECT_NE(client.ReadUntil("\x88").find("\x88\x02\x03\xE8"), std::string::npos);
  EXPECT_TRUE(client.IsClosedByServer());
}

TEST_F(WebServerTest, FloodOfCommands_HangsUp) {
  Start();
  ExpectFloodIsEnded(Frame(kBinary, kCommand));
}

TEST_F(WebServerTest, SilentViewer_IsHungUpOnWhileOthersGetTheirMessages) {
  Start("", 32, 5);
  RawClient silent(port());
  silent.Send(Upgrade(port()));
  ASSERT_EQ(StatusOf(silent.ReadUntil("hello")), 101);
  // It answers no ping, and from now on reads nothing.
  RawClient other(port());
  other.Send(Upgrade(port()));
  ASSERT_EQ(StatusOf(other.ReadUntil("hello")), 101);
  constexpr std::size_t kMuch = 1'000'000;
  for (int i = 0; i < 20; ++i) {
    board_.Put(1, MessageBoard::Bytes(kMuch, 'm'));
    server_->Notify();
  }
  board_.Put(1, {'n', 'e', 'w', 's'});
  server_->Notify();
  EXPECT_NE(other.ReadUntil("news").find("news"), std::string::npos);
  EXPECT_TRUE(silent.IsClosedByServer());
  EXPECT_TRUE(Serves());
}

TEST(WebServerAddress, PortInUse_IsSaid) {
  const MessageBoard board(1, 1);
  WebServer first({}, kPage, board, [](auto) {});
  ASSERT_TRUE(first.Start().ok());
  WebServerOptions options;
  options.address.port = first.port();
  WebServer second(options, kPage, board, [](auto) {});
  const hal::Fault fault = second.Start();
  EXPECT_EQ(fault.status, Status::kBusy);
  EXPECT_NE(std::string(fault.message).find("choose another port"), std::string::npos);
}

TEST(WebServerAddress, AddressOfAnotherMachine_IsSaid) {
  const MessageBoard board(1, 1);
  WebServerOptions options;
  options.address.host = "192.0.2.1";
  WebServer server(options, kPage, board, [](auto) {});
  EXPECT_EQ(server.Start().status, Status::kNotFound);
}

}  // namespace
}  // namespace disflow
