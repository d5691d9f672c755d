// SPDX-License-Identifier: BSD-3-Clause
// The live view's server in a process that falls short of descriptors.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <ctime>
#include <optional>
#include <thread>
#include <vector>

#include "disflow/posix/view/web_server.h"
#include "raw_client.h"

namespace disflow {
namespace {

constexpr std::array<std::uint8_t, 4> kContent = {'p', 'a', 'g', 'e'};
constexpr std::array kPage = {posix::WebAsset{"/", "text/html; charset=utf-8", kContent}};

/// Lets this process open no further files.
class NoMoreFiles {
 public:
  /// @param left So many more may be opened.
  explicit NoMoreFiles(int left) {
    (void)::getrlimit(RLIMIT_NOFILE, &before_);
    rlimit limit = before_;
    // Descriptors are the lowest numbers that are free.
    std::vector<int> free;
    for (int i = 0; i <= left; ++i) free.push_back(::dup(STDERR_FILENO));
    limit.rlim_cur = static_cast<rlim_t>(free.back());
    for (const int descriptor : free) ::close(descriptor);
    (void)::setrlimit(RLIMIT_NOFILE, &limit);
  }
  NoMoreFiles(const NoMoreFiles&) = delete;
  NoMoreFiles& operator=(const NoMoreFiles&) = delete;
  ~NoMoreFiles() { (void)::setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

TEST(WebServerLimits, DescriptorsThatRunOut_LeaveTheServerAtRestAndServingAfterwards) {
  const posix::MessageBoard board(2, 4);
  posix::WebServer server({}, kPage, board, [](auto) {});
  const hal::Fault fault = server.Start();
  ASSERT_TRUE(fault.ok()) << fault.message;
  std::optional<NoMoreFiles> limit(1);
  RawClient client(server.port());
  client.Send("GET / HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server.port()) + "\r\n\r\n");
  const std::clock_t before = std::clock();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_LT(std::clock() - before, CLOCKS_PER_SEC / 10) << "processor time of the whole process";
  limit.reset();
  EXPECT_EQ(StatusOf(client.ReadUntil("page")), 200);
}

}  // namespace
}  // namespace disflow
