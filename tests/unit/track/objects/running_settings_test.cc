// SPDX-License-Identifier: BSD-3-Clause
#include "objects/running_settings.h"

#include <gtest/gtest.h>

#include <limits>
#include <string_view>

#include "disflow/config_fields.h"

namespace disflow::apps {
namespace {

std::size_t NumberOf(std::string_view name) {
  std::size_t place = 0;
  std::size_t number = 0;
  const Config config;
  VisitFields(config, [&](const auto& field) {
    if (name == field.name) number = place;
    ++place;
  });
  return number;
}

TEST(RunningSettings, WhatWasChanged_IsTakenOnce) {
  RunningSettings settings{Config{}};
  Config taken;
  EXPECT_FALSE(settings.Take(taken));
  EXPECT_TRUE(settings.Set(NumberOf("registration.iterations"), 20));
  EXPECT_EQ(settings.Now().registration.iterations, 20);
  ASSERT_TRUE(settings.Take(taken));
  EXPECT_EQ(taken.registration.iterations, 20);
  EXPECT_FALSE(settings.Take(taken));
  EXPECT_EQ(settings.version(), 1U);
}

TEST(RunningSettings, WhatASettingCannotBe_ChangesNothing) {
  RunningSettings settings{Config{}};
  const std::size_t iterations = NumberOf("registration.iterations");
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double value : {kNan, kInfinity, -kInfinity, 0.0, 51.0, 10.5, 1e300})
    EXPECT_FALSE(settings.Set(iterations, value)) << value;
  // What the model is made with, what does not go with the others, and what there is not.
  EXPECT_FALSE(settings.Set(NumberOf("field.cell_size_m"), 0.05));
  EXPECT_FALSE(settings.Set(NumberOf("segmenter.seed_u_px"), 5));
  EXPECT_FALSE(settings.Set(NumberOf("segmenter.min_range_m"), 50.0));
  for (const std::size_t number : {std::size_t{1000}, std::numeric_limits<std::size_t>::max()})
    EXPECT_FALSE(settings.Set(number, 1.0));
  const Config defaults;
  const Config now = settings.Now();
  EXPECT_EQ(now.registration.iterations, defaults.registration.iterations);
  EXPECT_EQ(now.field.cell_size_m, defaults.field.cell_size_m);
  EXPECT_EQ(now.segmenter.seed_u_px, defaults.segmenter.seed_u_px);
  EXPECT_EQ(now.segmenter.min_range_m, defaults.segmenter.min_range_m);
}

TEST(RunningSettings, SettingsThatGoTogetherOnlyTogether_CanBeChangedAtOnce) {
  RunningSettings settings{Config{}};
  const ConfigIssue issue = settings.Change([](Config& config) {
    config.segmenter.min_range_m = 50.0F;
    config.segmenter.max_range_m = 60.0F;
  });
  EXPECT_EQ(issue.field, nullptr);
  EXPECT_EQ(settings.Now().segmenter.min_range_m, 50.0F);
}

}  // namespace
}  // namespace disflow::apps
