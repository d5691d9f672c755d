// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/realtime.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>

#include <string>
#include <thread>

namespace disflow::posix {
namespace {

/// The kernel's answer differs from machine to machine; that it is reported must not.
TEST(Realtime, Priority_IsInForceOrRefusedWithWhatToGrant) {
  std::thread([] {
    const hal::Fault fault = SetThisThreadPriority(10);
    if (fault.ok()) {
      EXPECT_EQ(::sched_getscheduler(0) & ~SCHED_RESET_ON_FORK, SCHED_FIFO);
    } else {
      EXPECT_NE(std::string(fault.message).find("LimitRTPRIO=10"), std::string::npos)
          << fault.message;
    }
  }).join();
}

TEST(Realtime, PriorityThatDoesNotExist_IsRefused) {
  std::thread([] { EXPECT_FALSE(SetThisThreadPriority(1000).ok()); }).join();
}

TEST(Realtime, Processor_IsTheOnlyOneAfterwards) {
  std::thread([] {
    const int cpu = ::sched_getcpu();
    ASSERT_TRUE(PinThisThread(cpu).ok());
    cpu_set_t set;
    ASSERT_EQ(::sched_getaffinity(0, sizeof(set), &set), 0);
    EXPECT_EQ(CPU_COUNT(&set), 1);
    EXPECT_TRUE(CPU_ISSET(static_cast<unsigned>(cpu), &set));
  }).join();
}

TEST(Realtime, ProcessorThatIsNotThere_IsNamed) {
  for (const int cpu : {-1, CPU_SETSIZE - 1, CPU_SETSIZE, 1 << 30}) {
    const hal::Fault fault = PinThisThread(cpu);
    EXPECT_EQ(fault.status, Status::kNotFound);
    EXPECT_NE(std::string(fault.message).find(std::to_string(cpu)), std::string::npos);
  }
}

TEST(Realtime, LockedMemory_IsLockedOrRefusedWithWhatToGrant) {
  const hal::Fault fault = LockMemory();
  if (!fault.ok()) {
    EXPECT_NE(std::string(fault.message).find("LimitMEMLOCK"), std::string::npos) << fault.message;
  }
  (void)::munlockall();
}

}  // namespace
}  // namespace disflow::posix
