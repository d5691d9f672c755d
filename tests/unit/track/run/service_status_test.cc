// SPDX-License-Identifier: BSD-3-Clause
#include "run/service_status.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include "service_manager.h"

namespace disflow::apps {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kStart_ns = 50 * kSecond_ns;

FrameResult Tracked(std::int64_t frame, TrackingState state, std::uint8_t quality) {
  FrameResult result;
  result.frame = frame;
  result.estimate.state = state;
  result.estimate.quality = quality;
  return result;
}

class ServiceStatusTest : public testing::Test {
 protected:
  ServiceStatusTest() { manager_.StartWatchdog(4'000'000); }
  test::ServiceManager manager_;
};

TEST_F(ServiceStatusTest, EveryTwoSeconds_StateRateAndLossesAreTold) {
  ServiceStatus status;
  std::vector<std::string> told;
  for (int i = 1; i <= 150; ++i) {
    std::array results{Tracked(i, TrackingState::kTracking, 93)};
    results[0].sensor.dropped = 4;
    status.Turn(results, true, kStart_ns + i * kSecond_ns / 30);
    for (const std::string& message : manager_.Received()) {
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
  (void)manager_.Received();
  status.Turn(results, true, kStart_ns + 3 * kSecond_ns);
  const std::vector<std::string> told = manager_.Received();
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
      for (const std::string& message : manager_.Received())
        count += message == "WATCHDOG=1" ? 1 : 0;
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
  for (const std::string& message : manager_.Received()) EXPECT_LT(message.size(), 200U);
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
