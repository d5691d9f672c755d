// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "disflow.h"

namespace disflow::testing {
namespace {

disflow_status Create(const disflow_setting& setting, disflow_setting_info& refused) {
  static std::vector<std::uint64_t> memory(DISFLOW_MICRO_BYTES / 8);
  disflow_tracker* tracker = nullptr;
  const disflow_status status = disflow_create(&disflow_micro, memory.data(), 8 * memory.size(),
                                               &setting, 1, &tracker, &refused);
  EXPECT_EQ(tracker != nullptr, status == DISFLOW_OK);
  return status;
}

std::vector<disflow_setting_info> AllSettings() {
  std::vector<disflow_setting_info> all(static_cast<std::size_t>(disflow_setting_count()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(disflow_describe_setting(static_cast<std::int32_t>(i), &all[i]), DISFLOW_OK);
  }
  return all;
}

TEST(CSettings, EachOfThem_TakesItsDefaultAndRefusesWhatIsBeyondItsRange) {
  const std::vector<disflow_setting_info> all = AllSettings();
  ASSERT_GT(all.size(), 50U);
  for (const disflow_setting_info& info : all) {
    disflow_setting_info refused;
    EXPECT_EQ(Create({info.name, info.default_value}, refused), DISFLOW_OK) << info.name;
    EXPECT_EQ(refused.name, nullptr);
    const float step = info.is_integer != 0 ? 1.0F : 0.01F * (info.max - info.min);
    for (const float value : {info.min - step, info.max + step}) {
      EXPECT_EQ(Create({info.name, value}, refused), DISFLOW_INVALID_CONFIG) << info.name;
      EXPECT_STREQ(refused.name, info.name);
      EXPECT_EQ(refused.max, info.max);
    }
    EXPECT_EQ(Create({info.name, std::numeric_limits<float>::quiet_NaN()}, refused),
              DISFLOW_INVALID_CONFIG)
        << info.name;
    if (info.is_integer == 0) continue;
    EXPECT_EQ(Create({info.name, info.min + 0.5F}, refused), DISFLOW_INVALID_CONFIG) << info.name;
    EXPECT_EQ(Create({info.name, 1e30F}, refused), DISFLOW_INVALID_CONFIG) << info.name;
  }
}

TEST(CSettings, NameThatThereIsNot_IsRefusedByName) {
  disflow_setting_info refused;
  EXPECT_EQ(Create({"sampler.colour", 1.0F}, refused), DISFLOW_NOT_FOUND);
  EXPECT_STREQ(refused.name, "sampler.colour");
  EXPECT_EQ(Create({nullptr, 1.0F}, refused), DISFLOW_NOT_FOUND);
}

TEST(CSettings, IndexBeyondTheLast_IsRefused) {
  disflow_setting_info info;
  EXPECT_EQ(disflow_describe_setting(disflow_setting_count(), &info), DISFLOW_OUT_OF_BOUNDS);
  EXPECT_EQ(disflow_describe_setting(-1, &info), DISFLOW_OUT_OF_BOUNDS);
  EXPECT_EQ(disflow_describe_setting(0, nullptr), DISFLOW_NOT_INITIALISED);
}

TEST(CSettings, ThatIsSet_IsInForce) {
  // With a region of interest of one pixel there is no object.
  static std::vector<std::uint64_t> memory(DISFLOW_MICRO_BYTES / 8);
  const std::vector<disflow_setting> settings{{"segmenter.roi_width_px", 1.0F},
                                              {"segmenter.roi_height_px", 1.0F}};
  disflow_tracker* tracker = nullptr;
  ASSERT_EQ(disflow_create(&disflow_micro, memory.data(), 8 * memory.size(), settings.data(),
                           settings.size(), &tracker, nullptr),
            DISFLOW_OK);
  const std::vector<float> wall(160 * 120, 0.5F);
  disflow_frame frame{};
  frame.depth = wall.data();
  frame.depth_format = DISFLOW_DEPTH_FLOAT32;
  frame.width_px = 160;
  frame.height_px = 120;
  frame.fx_px = frame.fy_px = 150.0F;
  frame.stamp_ns = 1;
  disflow_estimate estimate;
  EXPECT_NE(disflow_process(tracker, &frame, &estimate), DISFLOW_OK);
  EXPECT_LT(estimate.samples, 2);
}

}  // namespace
}  // namespace disflow::testing
