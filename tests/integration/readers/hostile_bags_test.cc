// SPDX-License-Identifier: BSD-3-Clause
#include "hostile_bags.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <string>

#include "disflow/posix/rosbag/bag_sensor.h"
#include "limited_process.h"
#include "scratch_folder.h"

namespace disflow::test {
namespace {

namespace fs = std::filesystem;

/// Plays all of it. @return What was said first against it; empty if nothing was.
std::string Play(const fs::path& file, bool with_masks) {
  posix::BagOptions options;
  options.path = file;
  options.depth_topic = kHostileDepth;
  options.info_topic = kHostileInfo;
  if (with_masks) options.mask_topic = kHostileMask;
  options.rectified = true;
  posix::BagSensor sensor(options);
  hal::Fault fault = sensor.Open();
  if (!fault.ok()) return fault.message;
  std::string first;
  DepthFrame frame;
  for (;;) {
    fault = sensor.Next(0, frame);
    if (fault.status == Status::kEndOfStream || fault.status == Status::kIoError) break;
    if (first.empty()) first = fault.message;
  }
  return fault.status == Status::kEndOfStream ? first : fault.message;
}

class HostileBagTest : public ScratchFolderTest, public testing::WithParamInterface<HostileBag> {};

TEST_P(HostileBagTest, IsPlayedOrRefusedInLittleMemoryAndTime) {
  const HostileBag& hostile = GetParam();
  const fs::path file = scratch() / hostile.name;
  const std::string contents = hostile.contents();
  ASSERT_GT(contents.size(), 0U);
  ASSERT_LE(contents.size(), 1'200'000U);
  WriteFile(file, contents);
  if (hostile.length >= 0) fs::resize_file(file, static_cast<std::uintmax_t>(hostile.length));
  const LimitedOutcome outcome =
      RunLimited([&] { return Play(file, hostile.with_masks); }, hostile.most_s);
  EXPECT_EQ(outcome.signal, 0) << "ended by this signal: " << ::strsignal(outcome.signal);
  EXPECT_EQ(outcome.message.empty(), std::string_view(hostile.fault).empty()) << outcome.message;
  EXPECT_NE(outcome.message.find(hostile.fault), std::string::npos) << outcome.message;
  EXPECT_EQ(outcome.message.find("bad_alloc"), std::string::npos) << outcome.message;
  EXPECT_LT(outcome.message.size(), 1000U) << "is for people";
}

INSTANTIATE_TEST_SUITE_P(Recordings, HostileBagTest, testing::ValuesIn(HostileBags()),
                         [](const testing::TestParamInfo<HostileBag>& test) {
                           return std::string(test.param.test);
                         });

}  // namespace
}  // namespace disflow::test
