// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/service_notifier.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "service_manager.h"

namespace disflow::posix {
namespace {

using test::ServiceManager;

TEST(ServiceNotifier, StartStatusAndEnd_AreTold) {
  const ServiceManager manager;
  ServiceNotifier notifier;
  ASSERT_TRUE(notifier.active());
  notifier.Ready();
  notifier.Status("tracking, quality 90");
  notifier.Stopping();
  EXPECT_EQ(manager.Received(),
            (std::vector<std::string>{"READY=1", "STATUS=tracking, quality 90", "STOPPING=1"}));
}

TEST(ServiceNotifier, SocketFile_IsReachedAsWell) {
  const std::string path = ::testing::TempDir() + "notify-" + std::to_string(::getpid());
  ::unlink(path.c_str());
  const ServiceManager manager(path);
  ServiceNotifier().Ready();
  EXPECT_EQ(manager.Received(), std::vector<std::string>{"READY=1"});
  ::unlink(path.c_str());
}

TEST(ServiceNotifier, Watchdog_IsFedFourTimesPerPeriod) {
  const ServiceManager manager;
  manager.StartWatchdog(2'000'000);
  ServiceNotifier notifier;
  constexpr std::int64_t kStep_ns = 100'000'000;
  for (std::int64_t i = 0; i < 20; ++i) notifier.Beat(i * kStep_ns);
  EXPECT_EQ(manager.Received(), std::vector<std::string>(4, "WATCHDOG=1"));
}

TEST(ServiceNotifier, WatchdogOfAnotherProcess_IsNotFed) {
  const ServiceManager manager;
  manager.StartWatchdog(2'000'000);
  ::setenv("WATCHDOG_PID", "1", 1);
  ServiceNotifier notifier;
  notifier.Beat(1);
  EXPECT_TRUE(manager.Received().empty());
}

TEST(ServiceNotifier, NobodyListening_IsNoFault) {
  const ServiceManager restores_environment;
  ::unsetenv("NOTIFY_SOCKET");
  ServiceNotifier none;
  EXPECT_FALSE(none.active());
  none.Ready();
  ::setenv("NOTIFY_SOCKET", "/nonexistent/socket", 1);
  ServiceNotifier gone;
  gone.Ready();
  gone.Beat(1);
}

TEST(ServiceNotifier, LongStatus_IsCut) {
  const ServiceManager manager;
  ServiceNotifier().Status(std::string(5000, 'x'));
  const std::vector<std::string> messages = manager.Received();
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].size(), 207U);
}

TEST(ServiceNotifier, SenselessEnvironment_IsIgnored) {
  const ServiceManager restores_environment;
  for (const char* name : {"", "x", "relative/path", "@"}) {
    ::setenv("NOTIFY_SOCKET", name, 1);
    EXPECT_FALSE(ServiceNotifier().active()) << name;
  }
  ::setenv("NOTIFY_SOCKET", ("/" + std::string(500, 'x')).c_str(), 1);
  EXPECT_FALSE(ServiceNotifier().active());
  ::setenv("NOTIFY_SOCKET", "@x", 1);
  for (const char* period : {"", "-5", "12x", "99999999999999999999999"}) {
    ::setenv("WATCHDOG_USEC", period, 1);
    EXPECT_EQ(ServiceNotifier().watchdog_ns(), 0) << period;
  }
}

}  // namespace
}  // namespace disflow::posix
