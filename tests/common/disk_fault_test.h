// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <utility>

#include "disflow/hal/fault.h"
#include "faulty_disk.h"
#include "scratch_dir.h"

namespace disflow::test {

/// A recording onto a disk that comes to its end, of any writer. The program links
/// disflow_faulty_disk.
class DiskFaultTest : public testing::Test {
 protected:
  void TearDown() override { disk = {}; }

  /// Records onto the disk as it is. @return How many frames were recorded without a fault.
  virtual std::size_t Record() = 0;
  [[nodiscard]] virtual std::filesystem::path path() const = 0;

  void ExpectSaysFull(const hal::Fault& fault) const {
    const std::string message = fault.message;
    EXPECT_NE(message.find(path().string()), std::string::npos) << message;
    EXPECT_NE(message.find("No space left"), std::string::npos) << message;
  }

  /// Records in another process, which is killed.
  void RecordAndBeKilled(const FaultyDisk& faulty) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      disk = faulty;
      (void)Record();
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "killed before it was done";
  }

  /// Any numbers, the same ones every time. @return 0 to bound - 1.
  std::int64_t Below(std::int64_t bound) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(bound));
  }
  bool Half() { return Below(2) == 0; }

  /// A thousand faults at any places of recordings of any size.
  /// @param make make() records anything as a whole and leaves in whole_ what that took.
  /// @param at_calls One of so many faults comes at a call that makes or closes something.
  /// @param complete_before complete_before(fault): frames that were complete when it came.
  /// @param expect expect(frames): so many can be played.
  template <class Make, class CompleteBefore, class Expect>
  void TryAThousandFaults(const Make& make, std::int64_t at_calls,
                          const CompleteBefore& complete_before, const Expect& expect) {
    constexpr int kRecordings = 125;
    constexpr int kFaults = 8;
    for (int recording = 0; recording < kRecordings; ++recording) {
      ASSERT_NO_FATAL_FAILURE(make());
      for (int i = 0; i < kFaults; ++i) {
        const FaultyDisk faulty = AnyFault(at_calls);
        SCOPED_TRACE("recording " + std::to_string(recording) + ", " + Describe(faulty));
        std::size_t complete = complete_before(faulty);
        if (faulty.end == DiskEnd::kKilled) {
          ASSERT_NO_FATAL_FAILURE(RecordAndBeKilled(faulty));
        } else {
          disk = faulty;
          complete = Record();
          disk = {};
        }
        expect(complete);
        if (HasFailure()) return;
      }
    }
  }

  apps::ScratchDir dir_;
  FaultyDisk whole_;

 private:
  FaultyDisk AnyFault(std::int64_t at_calls) {
    constexpr std::array<DiskEnd, 3> kEnds{DiskEnd::kFull, DiskEnd::kFullForAll, DiskEnd::kKilled};
    FaultyDisk faulty;
    faulty.end = kEnds[static_cast<std::size_t>(Below(kEnds.size()))];
    faulty.can_cut = Half();
    if (Below(at_calls) == 0) {
      faulty.room_calls = Below(whole_.calls);
    } else {
      faulty.room_bytes = Below(whole_.written_bytes);
    }
    return faulty;
  }

  static std::string Describe(const FaultyDisk& faulty) {
    const std::string what = faulty.end == DiskEnd::kKilled ? "killed after " : "full after ";
    return faulty.room_calls == FaultyDisk::kEndless
               ? what + std::to_string(faulty.room_bytes) + " bytes"
               : what + std::to_string(faulty.room_calls) + " calls";
  }

  std::mt19937_64 random_{20261127};
};

}  // namespace disflow::test
