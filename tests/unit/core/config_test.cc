// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/config.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "changed_config.h"
#include "disflow/config_fields.h"

namespace disflow {
namespace {

const auto kBelow = [](auto, auto min, auto) {
  if constexpr (std::is_same_v<decltype(min), float>) {
    return std::nextafter(min, -std::numeric_limits<float>::infinity());
  } else {
    return min - 1;
  }
};
const auto kAbove = [](auto, auto, auto max) {
  if constexpr (std::is_same_v<decltype(max), float>) {
    return std::nextafter(max, std::numeric_limits<float>::infinity());
  } else {
    return max + 1;
  }
};
TEST(Config, Defaults_AreValid) {
  const ConfigIssue issue = Validate(Config{});
  EXPECT_EQ(issue.field, nullptr) << issue.field;
  EXPECT_EQ(issue.status(), Status::kOk);
}

TEST(Config, EverySetting_IsListed) {
  // All settings are of four bytes, so one that VisitFields() forgets shows in the size.
  EXPECT_EQ(static_cast<std::size_t>(FieldCount()) * sizeof(float), sizeof(Config));
}

TEST(Config, EverySetting_HasItsOwnNameUnitAndMeaning) {
  Config config;
  std::set<std::string> names;
  std::set<const void*> values;
  VisitFields(config, [&](auto field) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name << " twice";
    EXPECT_TRUE(values.insert(&field.value).second) << field.name << " names another's value";
    EXPECT_NE(std::string(field.name).find('.'), std::string::npos) << field.name;
    EXPECT_FALSE(std::string(field.unit).empty()) << field.name;
    EXPECT_FALSE(std::string(field.meaning).empty()) << field.name;
    EXPECT_LT(field.min, field.max) << field.name;
  });
}

TEST(Config, ValueBelowMinimum_IsNamed) {
  for (int i = 0; i < FieldCount(); ++i) {
    Config config;
    const std::string name = ChangeField(config, i, kBelow);
    const ConfigIssue issue = Validate(config);
    ASSERT_NE(issue.field, nullptr) << name;
    EXPECT_EQ(issue.field, name);
    EXPECT_LT(issue.value, issue.max);
    EXPECT_EQ(issue.status(), Status::kInvalidConfig);
  }
}

TEST(Config, ValueAboveMaximum_IsNamed) {
  for (int i = 0; i < FieldCount(); ++i) {
    Config config;
    const std::string name = ChangeField(config, i, kAbove);
    const ConfigIssue issue = Validate(config);
    ASSERT_NE(issue.field, nullptr) << name;
    EXPECT_EQ(issue.field, name);
    EXPECT_GT(issue.value, issue.max);
  }
}

TEST(Config, NotANumber_IsNamed) {
  for (int i = 0; i < FieldCount(); ++i) {
    Config config;
    bool is_float = false;
    const std::string name = ChangeField(config, i, [&is_float](auto value, auto min, auto) {
      is_float = std::is_same_v<decltype(value), float>;
      return is_float ? std::numeric_limits<decltype(value)>::quiet_NaN() : min;
    });
    if (!is_float) continue;
    const ConfigIssue issue = Validate(config);
    ASSERT_NE(issue.field, nullptr) << name;
    EXPECT_EQ(issue.field, name);
    EXPECT_TRUE(std::isnan(issue.value));
  }
}

TEST(Config, BothEndsOfEveryRange_AreAllowed) {
  for (int i = 0; i < FieldCount(); ++i) {
    // The widest partners, so that only the setting itself can be at fault.
    Config config;
    config.segmenter.min_range_m = 0.0F;
    config.segmenter.max_range_m = 100.0F;
    config.sampler.min_block_px = 1;
    config.sampler.max_block_px = 64;
    config.field.merge_radius_m = 1e-4F;
    config.registration.match_radius_m = 1.0F;
    config.segmenter.seed_u_px = config.segmenter.seed_v_px = 0;
    config.segmenter.roi_width_px = config.segmenter.roi_height_px = 1;
    Config lowest = config;
    const std::string name = ChangeField(lowest, i, kMinimum);
    // The lowest of these says that there is none, which half a pixel or region cannot.
    if (name.starts_with("segmenter.seed_") || name.starts_with("segmenter.roi_")) {
      static_cast<ObjectStart&>(lowest.segmenter) = {};
      ChangeField(lowest, i, kMinimum);
    }
    EXPECT_EQ(Validate(lowest).field, nullptr) << name;
    if (name == "segmenter.min_range_m") continue;  // must stay below the farthest depth
    Config highest = config;
    ChangeField(highest, i, kMaximum);
    EXPECT_EQ(Validate(highest).field, nullptr) << name;
  }
}

TEST(Config, RangeThatIsEmpty_IsNamed) {
  Config config;
  config.segmenter.max_range_m = config.segmenter.min_range_m;
  EXPECT_STREQ(Validate(config).field, "segmenter.max_range_m");
}

TEST(Config, LargestBlockBelowSmallest_IsNamed) {
  Config config;
  config.sampler.min_block_px = 8;
  config.sampler.max_block_px = 7;
  EXPECT_STREQ(Validate(config).field, "sampler.max_block_px");
}

TEST(Config, HalfOfASeedPixel_OtherHalfIsNamed) {
  Config config;
  config.segmenter.seed_u_px = 320;
  EXPECT_STREQ(Validate(config).field, "segmenter.seed_v_px");
  std::swap(config.segmenter.seed_u_px, config.segmenter.seed_v_px);
  EXPECT_STREQ(Validate(config).field, "segmenter.seed_u_px");
  config.segmenter.seed_u_px = 0;
  EXPECT_EQ(Validate(config).field, nullptr);
}

TEST(Config, RegionWithoutExtent_WhatIsMissingIsNamed) {
  Config config;
  config.segmenter.roi_x_px = 10;
  const ConfigIssue issue = Validate(config);
  EXPECT_STREQ(issue.field, "segmenter.roi_width_px");
  EXPECT_EQ(issue.min, 1.0);
  config.segmenter.roi_width_px = 100;
  EXPECT_STREQ(Validate(config).field, "segmenter.roi_height_px");
  config.segmenter.roi_height_px = 100;
  EXPECT_EQ(Validate(config).field, nullptr);
}

TEST(Config, MatchesNearerThanSamplesLieApart_AreNamed) {
  Config config;
  config.field.merge_radius_m = 0.03F;
  const ConfigIssue issue = Validate(config);
  EXPECT_STREQ(issue.field, "registration.match_radius_m");
  EXPECT_FLOAT_EQ(static_cast<float>(issue.min), 0.03F);
}

TEST(Config, SeveralBadSettings_FirstIsNamed) {
  Config config;
  config.monitor.lost_after_frames = 0;
  config.field.length_scale_m = -1.0F;
  const ConfigIssue issue = Validate(config);
  EXPECT_STREQ(issue.field, "field.length_scale_m");
  EXPECT_EQ(issue.value, -1.0);
}

}  // namespace
}  // namespace disflow
