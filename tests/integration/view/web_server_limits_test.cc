// SPDX-License-Identifier: BSD-3-Clause
// The live view's server in a process that falls short of descriptors.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <ctime>
#include <optional>
#include <thread>
#include <vector>

#include "disflow/posix/view/web_server.h"
#include "raw_client.h"
#include "resource_limit.h"

namespace disflow {
namespace {

constexpr std::array<std::uint8_t, 4> kContent = {'p', 'a', 'g', 'e'};
constexpr std::array kPage = {posix::WebAsset{"/", "text/html; charset=utf-8", kContent}};

/// Above the highest descriptor when so many more are open: they are the lowest numbers that are
/// free.
rlim_t DescriptorsAnd(int more) {
  std::vector<int> free;
  for (int i = 0; i <= more; ++i) free.push_back(::dup(STDERR_FILENO));
  for (const int descriptor : free) ::close(descriptor);
  return static_cast<rlim_t>(free.back());
}

TEST(WebServerLimits, DescriptorsThatRunOut_LeaveTheServerAtRestAndServingAfterwards) {
  const posix::MessageBoard board(2, 4);
  posix::WebServer server({}, kPage, board, [](auto) {});
  const hal::Fault fault = server.Start();
  ASSERT_TRUE(fault.ok()) << fault.message;
  std::optional<test::ResourceLimit> limit(std::in_place, RLIMIT_NOFILE, DescriptorsAnd(1));
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
