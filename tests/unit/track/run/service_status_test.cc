// SPDX-License-Identifier: BSD-3-Clause
#include "run/service_status.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace disflow::apps {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kStart_ns = 50 * kSecond_ns;

/// Listens as systemd does.
class ServiceStatusTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string name = "@disflow-status-" + std::to_string(::getpid());
    sockaddr_un own{};
    own.sun_family = AF_UNIX;
    std::memcpy(own.sun_path, name.data(), name.size());
    own.sun_path[0] = '\0';
    socket_ = posix::FileDescriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0));
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    ASSERT_EQ(::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&own), size), 0);
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
    ::setenv("WATCHDOG_USEC", "4000000", 1);
  }
  void TearDown() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC"}) ::unsetenv(name);
  }
  std::vector<std::string> Received() {
    std::vector<std::string> messages;
    std::array<char, 512> buffer{};
    for (;;) {
      const ssize_t size = ::recv(socket_.get(), buffer.data(), buffer.size(), 0);
      if (size < 0) return messages;
      messages.emplace_back(buffer.data(), static_cast<std::size_t>(size));
    }
  }

 private:
  posix::FileDescriptor socket_;
};

FrameResult Tracked(std::int64_t frame, TrackingState state, std::uint8_t quality) {
  FrameResult result;
  result.frame = frame;
  result.estimate.state = state;
  result.estimate.quality = quality;
  return result;
}

TEST_F(ServiceStatusTest, EveryTwoSeconds_StateRateAndLossesAreTold) {
  ServiceStatus status;
  std::vector<std::string> told;
  for (int i = 1; i <= 150; ++i) {
    std::array results{Tracked(i, TrackingState::kTracking, 93)};
    results[0].sensor.dropped = 4;
    status.Turn(results, true, kStart_ns + i * kSecond_ns / 30);
    for (const std::string& message : Received()) {
      if (message.starts_with("STATUS=")) told.push_back(message);
    }
  }
  ASSERT_EQ(told.size(), 3U);
  EXPECT_EQ(told[1], "STATUS=tracking, quality 93, 30.0 frames/s, 4 frames dropped");
  EXPECT_EQ(told[2], told[1]);
}

TEST_F(ServiceStatusTest, SilentSensor_IsTold) {
  ServiceStatus status;
  const std::array results{Tracked(5, TrackingState::kTracking, 90)};
  status.Turn(results, true, kStart_ns);
  (void)Received();
  status.Turn(results, true, kStart_ns + 3 * kSecond_ns);
  const std::vector<std::string> told = Received();
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back(), "STATUS=no frames from the sensor");
}

TEST_F(ServiceStatusTest, HangingSource_StarvesTheWatchdog) {
  ServiceStatus status;
  const auto beats = [&](bool alive, std::int64_t from_ns) {
    int count = 0;
    for (int i = 0; i < 40; ++i) {
      status.Turn(std::array{Tracked(i, TrackingState::kLost, 0)}, alive,
                  from_ns + i * kSecond_ns / 10);
      for (const std::string& message : Received()) count += message == "WATCHDOG=1" ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(beats(true, kStart_ns), 4);
  EXPECT_EQ(beats(false, kStart_ns + 10 * kSecond_ns), 0);
}

TEST_F(ServiceStatusTest, ManyObjects_AreCutAtOneLine) {
  ServiceStatus status;
  const std::vector<FrameResult> results(40, Tracked(9, TrackingState::kInitialising, 50));
  status.Turn(results, true, kStart_ns);
  for (const std::string& message : Received()) EXPECT_LT(message.size(), 200U);
}

TEST(ServiceStatus, NobodyListening_IsNoFault) {
  ::unsetenv("NOTIFY_SOCKET");
  ServiceStatus status;
  status.Ready();
  status.Turn(std::array{Tracked(1, TrackingState::kTracking, 90)}, true, kStart_ns);
  status.Stopping();
}

}  // namespace
}  // namespace disflow::apps
