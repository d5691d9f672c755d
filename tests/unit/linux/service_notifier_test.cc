// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/service_notifier.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace disflow::posix {
namespace {

/// What systemd does: a datagram socket, and its name in the environment.
class ServiceManager : public ::testing::Test {
 protected:
  void Listen(const std::string& name) {
    sockaddr_un own{};
    own.sun_family = AF_UNIX;
    std::memcpy(own.sun_path, name.data(), name.size());
    if (name[0] == '@') own.sun_path[0] = '\0';
    socket_ = FileDescriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0));
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    ASSERT_EQ(::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&own), size), 0);
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
  }
  void TearDown() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
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
  static std::string AbstractName() { return "@disflow-test-" + std::to_string(::getpid()); }

 private:
  FileDescriptor socket_;
};

TEST_F(ServiceManager, StartStatusAndEnd_AreTold) {
  Listen(AbstractName());
  ServiceNotifier notifier;
  ASSERT_TRUE(notifier.active());
  notifier.Ready();
  notifier.Status("tracking, quality 90");
  notifier.Stopping();
  EXPECT_EQ(Received(),
            (std::vector<std::string>{"READY=1", "STATUS=tracking, quality 90", "STOPPING=1"}));
}

TEST_F(ServiceManager, SocketFile_IsReachedAsWell) {
  const std::string path = ::testing::TempDir() + "notify-" + std::to_string(::getpid());
  ::unlink(path.c_str());
  Listen(path);
  ServiceNotifier().Ready();
  EXPECT_EQ(Received(), std::vector<std::string>{"READY=1"});
  ::unlink(path.c_str());
}

TEST_F(ServiceManager, Watchdog_IsFedFourTimesPerPeriod) {
  Listen(AbstractName());
  ::setenv("WATCHDOG_USEC", "2000000", 1);
  ServiceNotifier notifier;
  constexpr std::int64_t kStep_ns = 100'000'000;
  for (std::int64_t i = 0; i < 20; ++i) notifier.Beat(i * kStep_ns);
  EXPECT_EQ(Received(), std::vector<std::string>(4, "WATCHDOG=1"));
}

TEST_F(ServiceManager, WatchdogOfAnotherProcess_IsNotFed) {
  Listen(AbstractName());
  ::setenv("WATCHDOG_USEC", "2000000", 1);
  ::setenv("WATCHDOG_PID", "1", 1);
  ServiceNotifier notifier;
  notifier.Beat(1);
  EXPECT_TRUE(Received().empty());
}

TEST_F(ServiceManager, NobodyListening_IsNoFault) {
  ::unsetenv("NOTIFY_SOCKET");
  ServiceNotifier none;
  EXPECT_FALSE(none.active());
  none.Ready();
  ::setenv("NOTIFY_SOCKET", "/nonexistent/socket", 1);
  ServiceNotifier gone;
  gone.Ready();
  gone.Beat(1);
}

TEST_F(ServiceManager, LongStatus_IsCut) {
  Listen(AbstractName());
  ServiceNotifier().Status(std::string(5000, 'x'));
  const std::vector<std::string> messages = Received();
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].size(), 207U);
}

TEST_F(ServiceManager, SenselessEnvironment_IsIgnored) {
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
