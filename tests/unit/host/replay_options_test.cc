// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/replay_options.h"

#include <gtest/gtest.h>

#include <string>

namespace disflow::host {
namespace {

hal::Fault Parse(const std::string& text, ReplayOptions& options) {
  Uri uri;
  const hal::Fault fault = ParseUri(text, uri);
  return fault.ok() ? ParseReplayUri(uri, options) : fault;
}

TEST(ReplayOptions, EveryKey_ReachesItsField) {
  ReplayOptions options;
  const hal::Fault fault = Parse(
      "replay:/data/run "
      "1?mask=mrcnn&object=bottle&scale=0.0001&fps=12.5&K=570.5,571,306.25,238&T_wc=poses&"
      "first=3&count=20",
      options);
  ASSERT_TRUE(fault.ok()) << fault.message;
  EXPECT_EQ(options.dir, "/data/run 1");
  EXPECT_EQ(options.mask_set, "mrcnn");
  EXPECT_EQ(options.object, "bottle");
  EXPECT_EQ(options.unit_m, 0.0001);
  EXPECT_EQ(options.rate_hz, 12.5);
  ASSERT_TRUE(options.camera.has_value());
  EXPECT_EQ(options.camera->fx_px, 570.5F);
  EXPECT_EQ(options.camera->fy_px, 571.0F);
  EXPECT_EQ(options.camera->cx_px, 306.25F);
  EXPECT_EQ(options.camera->cy_px, 238.0F);
  EXPECT_EQ(options.world_poses, WorldPoses::kGiven);
  EXPECT_EQ(options.first, 3);
  EXPECT_EQ(options.count, 20);
}

struct BadAddress {
  const char* name;
  const char* text;
  const char* named;  // what the message must name
};

void PrintTo(const BadAddress& address, std::ostream* stream) { *stream << address.name; }

class BadReplayAddress : public testing::TestWithParam<BadAddress> {};

TEST_P(BadReplayAddress, IsNamed) {
  ReplayOptions options;
  const hal::Fault fault = Parse(GetParam().text, options);
  EXPECT_EQ(fault.status, Status::kInvalidUri);
  EXPECT_NE(std::string(fault.message).find(GetParam().named), std::string::npos) << fault.message;
  EXPECT_TRUE(options.dir.empty()) << "options must stay as they were";
}

INSTANTIATE_TEST_SUITE_P(All, BadReplayAddress,
                         testing::Values(BadAddress{"UnknownOption", "replay:x?msk=gt", "msk"},
                                         BadAddress{"EmptyMask", "replay:x?mask=", "mask"},
                                         BadAddress{"MaskOutside", "replay:x?mask=../up", "mask"},
                                         BadAddress{"MaskAbove", "replay:x?mask=..", "mask"},
                                         BadAddress{"ScaleZero", "replay:x?scale=0", "scale"},
                                         BadAddress{"RateZero", "replay:x?fps=0", "fps"},
                                         BadAddress{"ScaleNoNumber", "replay:x?scale=mm", "scale"},
                                         BadAddress{"UnknownPoses", "replay:x?T_wc=yes", "poses"},
                                         BadAddress{"NegativeFirst", "replay:x?first=-1", "first"},
                                         BadAddress{"NoFrames", "replay:x?count=0", "count"},
                                         BadAddress{"ThreeIntrinsics", "replay:x?K=1,2,3", "cy"},
                                         BadAddress{"NoFocalLength", "replay:x?K=0,500,3,4", "fx"},
                                         BadAddress{"FiveIntrinsics", "replay:x?K=500,500,3,4,5",
                                                    "four"}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace disflow::host
