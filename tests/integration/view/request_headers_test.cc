// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "disflow/posix/view/web_server.h"
#include "raw_client.h"

namespace disflow {
namespace {

using posix::MessageBoard;
using posix::WebAsset;
using posix::WebServer;
using posix::WebServerOptions;

constexpr std::array<std::uint8_t, 6> kContent = {'s', 'e', 'c', 'r', 'e', 't'};
constexpr std::array kPage = {WebAsset{"/", "text/html; charset=utf-8", kContent}};
constexpr int kLongest = 4096;
constexpr int kFitting = 3000;  // With the other headers, within what a request may have.

std::string Header(const std::string& name, const std::string& value) {
  return name + ": " + value + "\r\n";
}
std::string Letters(int count) { return std::string(static_cast<std::size_t>(count), 'a'); }

/// A server that says "secret" to whoever has the page, and "hello" to whoever has a WebSocket.
class RequestHeaders : public testing::Test {
 protected:
  RequestHeaders() {
    board_.Put(0, {'h', 'e', 'l', 'l', 'o'});
    WebServerOptions options;
    options.token = "correct-horse";
    options.request_timeout_s = 60;
    server_ = std::make_unique<WebServer>(options, kPage, board_, [](auto) {});
    const hal::Fault fault = server_->Start();
    EXPECT_TRUE(fault.ok()) << fault.message;
    cookie_ = Header("Cookie", "disflow_" + std::to_string(port()) + "=" + options.token);
    own_ = "http://localhost:" + std::to_string(port());
  }

  [[nodiscard]] int port() const { return server_->port(); }
  [[nodiscard]] std::string OfPage(const std::string& headers) const {
    return Get(port(), "/", cookie_ + headers);
  }
  [[nodiscard]] std::string OfSocket(const std::string& headers) const {
    return Ask(port(), Upgrade(port(), cookie_ + headers));
  }

  /// With the right token, and yet refused, unless the connection ended.
  static void ExpectRefused(const std::string& answer, int size) {
    const int status = StatusOf(answer);
    ASSERT_TRUE(status == 403 || status == 400 || (size > kFitting && status == 0))
        << size << ": " << answer;
    ASSERT_EQ(answer.find("secret"), std::string::npos) << size;
    ASSERT_EQ(answer.find("hello"), std::string::npos) << size;
  }
  void ExpectNothing(const std::string& headers, int size) {
    ExpectRefused(OfSocket(headers), size);
    ExpectRefused(OfPage(headers), size);
  }

  MessageBoard board_{2, 4};
  std::unique_ptr<WebServer> server_;
  std::string cookie_;
  std::string own_;
};

// An origin that did not fit a buffer once read as none, and none is what programs send that are
// no browsers.
TEST_F(RequestHeaders, ForeignOriginOfAnyLength_GetsNothingEvenWithTheToken) {
  for (int size = 0; size <= kLongest && !HasFatalFailure(); ++size) {
    ExpectNothing(Header("Origin", "https://" + Letters(size)), size);
  }
}

TEST_F(RequestHeaders, OriginThatBeginsLikeTheOwn_GetsNothing) {
  for (int size = 1; size <= kLongest && !HasFatalFailure(); size += 5) {
    ExpectNothing(Header("Origin", own_ + Letters(size)), size);
  }
}

TEST_F(RequestHeaders, OriginOfNothingButSpaces_GetsNothing) {
  for (int size = 0; size < 100 && !HasFatalFailure(); ++size) {
    ExpectNothing(Header("Origin", std::string(static_cast<std::size_t>(size), ' ')), size);
  }
}

TEST_F(RequestHeaders, SecondOrigin_GetsNothing) {
  const std::string own = Header("Origin", own_);
  const std::string foreign = Header("Origin", "https://example.org");
  ExpectNothing(own + foreign, 0);
  ExpectNothing(foreign + own, 0);
}

TEST_F(RequestHeaders, ForeignOriginAmongHeadersOfAnyLength_GetsNothing) {
  const std::string foreign = Header("Origin", "https://example.org");
  for (const char* name : {"X-Padding", "User-Agent", "Accept-Language", "Referer"}) {
    for (int size = 0; size <= kLongest && !HasFatalFailure(); size += 31) {
      ExpectNothing(Header(name, Letters(size)) + foreign, size);
      ExpectNothing(foreign + Header(name, Letters(size)), size);
    }
  }
}

TEST_F(RequestHeaders, ForeignHostOfAnyLength_GetsNothing) {
  for (int size = 1; size <= kLongest && !HasFatalFailure(); size += 5) {
    ExpectRefused(Get(port(), "/", cookie_ + Header("Host", Letters(size) + ":80")), size);
  }
}

TEST_F(RequestHeaders, OwnOriginAmongHeadersOfAnyLength_IsServedOrNotAnswered) {
  const std::string own = Header("Origin", own_);
  for (int size = 0; size <= kLongest; size += 17) {
    const std::string padding = Header("X-Padding", Letters(size));
    const int socket = StatusOf(OfSocket(padding + own));
    const int page = StatusOf(OfPage(own + padding));
    ASSERT_TRUE(socket == 101 || (size > kFitting && socket == 0)) << size << ": " << socket;
    ASSERT_TRUE(page == 200 || (size > kFitting && page == 0)) << size << ": " << page;
  }
}

}  // namespace
}  // namespace disflow
