// SPDX-License-Identifier: BSD-3-Clause
#include "settings/settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <type_traits>

#include "disflow/config_fields.h"
#include "program/exit_status.h"
#include "refusal.h"
#include "scratch_folder.h"

namespace disflow::apps {
namespace {

/// All values of a configuration, exact.
std::vector<double> Values(const Config& config) {
  std::vector<double> values;
  VisitFields(config,
              [&](const auto& field) { values.push_back(static_cast<double>(field.value)); });
  return values;
}

/// Any value of each setting that it may have on its own.
Config RandomConfig(std::mt19937_64& random) {
  Config config;
  VisitFields(config, [&](const auto& field) {
    using Value = std::remove_reference_t<decltype(field.value)>;
    const double value = std::uniform_real_distribution(field.min, field.max)(random);
    if constexpr (std::is_integral_v<Value>) {
      field.value = static_cast<Value>(std::floor(value));
    } else {
      // Rounding to a float must not leave the range.
      field.value = static_cast<Value>(value * 0.999);
      if (static_cast<double>(field.value) < field.min) field.value = static_cast<Value>(value);
    }
  });
  return config;
}

class SettingsFileTest : public test::ScratchFolderTest {
 protected:
  SettingsFile Load(const std::string& text) {
    test::WriteFile(Path("run.toml"), text);
    return LoadSettings(Path("run.toml"), config_);
  }
  std::string Refusal(const std::string& text) {
    return RefusalOf([&] { (void)Load(text); });
  }

  Config config_;
};

TEST_F(SettingsFileTest, AnyConfigurationWrittenAndRead_IsTheSameToTheLastBit) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 100; ++i) {
    const Config written = RandomConfig(random);
    (void)Load(FormatSettings(written));
    ASSERT_EQ(Values(config_), Values(written));
  }
}

TEST_F(SettingsFileTest, SettingNotMentioned_StaysAsItWas) {
  config_.registration.iterations = 17;
  (void)Load("[field]\ncell_size_m = 0.05\n");
  EXPECT_EQ(config_.registration.iterations, 17);
  EXPECT_EQ(config_.field.cell_size_m, 0.05F);
}

TEST_F(SettingsFileTest, ValuesWithoutSense_AreRefusedWithTheirLine) {
  for (const char* value :
       {"true", "'10'", "[1]", "{a = 1}", "1979-05-27", "inf", "nan", "-1", "1e9",
        "9223372036854775807", "-9223372036854775808", "10.5", "0xFFFFFFFF"}) {
    const std::string said =
        Refusal("\n\n[registration]\niterations = " + std::string(value) + "\n");
    EXPECT_NE(said.find("run.toml:4: registration.iterations"), std::string::npos)
        << value << ": " << said;
  }
}

TEST_F(SettingsFileTest, BytesThatAreNoToml_AreRefused) {
  for (const std::string& text :
       {std::string("\0\0\0\0", 4), std::string("[registration"), std::string("\xFF\xFE[a]"),
        std::string("a = 1\na = 2\n"), std::string(10'000, '['), std::string("a = \"\n")}) {
    EXPECT_NE(Refusal(text), "");
  }
}

TEST_F(SettingsFileTest, SectionRun_BecomesOptionsWithTheirPlace) {
  const SettingsFile file = Load(
      "[run]\nsensor = 'sim:box'\nmesh_picture = \"a.png\"\nheadless = true\nframes = 12\n"
      "range = [0.25, 2]\n");
  ASSERT_EQ(file.run.size(), 5U);
  std::map<std::string, std::vector<std::string>> options;
  for (const RunSetting& setting : file.run) {
    options[setting.option] = setting.values;
    EXPECT_EQ(setting.where.rfind(Path("run.toml:"), 0), 0U) << setting.where;
  }
  EXPECT_EQ(options["--sensor"], std::vector<std::string>{"sim:box"});
  EXPECT_EQ(options["--mesh-picture"], std::vector<std::string>{"a.png"});
  EXPECT_EQ(options["--headless"], std::vector<std::string>{"true"});
  EXPECT_EQ(options["--frames"], std::vector<std::string>{"12"});
  EXPECT_EQ(options["--range"], (std::vector<std::string>{"0.25", "2"}));
}

TEST_F(SettingsFileTest, Object_StartsFromTheWholeFileWhereverItStands) {
  const SettingsFile file = Load(
      "[[object]]\nname = 'box'\n[object.registration]\niterations = 7\n"
      "[[object]]\nname = 'can'\n"
      "[field]\ncell_size_m = 0.05\n[registration]\niterations = 9\n");
  ASSERT_EQ(file.objects.size(), 2U);
  EXPECT_EQ(file.objects[0].config.registration.iterations, 7);
  EXPECT_EQ(file.objects[1].config.registration.iterations, 9);
  for (const ObjectTable& object : file.objects) EXPECT_EQ(object.config.field.cell_size_m, 0.05F);
}

TEST_F(SettingsFileTest, ObjectsThatAreNoTables_AreRefused) {
  for (const char* text : {"object = 1\n", "object = [1, 2]\n", "[object]\nname = 'box'\n",
                           "object = [{name = 'a'}, 3]\n"}) {
    EXPECT_NE(Refusal(text).find("[[object]]"), std::string::npos) << text;
  }
}

TEST(ApplySetting, AssignmentWithoutSense_IsRefusedAndChangesNothing) {
  for (const char* assignment :
       {"", "=", "=1", "registration.iterations",
        "registration.iterations=", "registration.iterations= 5", "registration.iterations=5 ",
        "registration.iterations=0x5", "registration.iterations=5=6", "registration.iterations=nan",
        "registration.iterations=inf", "registration.iterations=1e999",
        "registration.iterations=-1e999", "registration.iterations=5.5", "registration=5",
        "Registration.iterations=5", "registration.iterations.=5"}) {
    Config config;
    EXPECT_THROW(ApplySetting(assignment, config), Failure) << assignment;
    EXPECT_EQ(Values(config), Values(Config{})) << assignment;
  }
}

TEST(ApplySetting, LimitsThemselves_AreAllowedAndWhatIsBeyondIsNot) {
  Config any;
  VisitFields(any, [](const auto& field) {
    for (const double limit : {field.min, field.max}) {
      Config config;
      char text[128];
      (void)std::snprintf(text, sizeof(text), "%s=%.17g", field.name, limit);
      EXPECT_NO_THROW(ApplySetting(text, config)) << text;
    }
    const double step = 1.0 + field.max - field.min;
    for (const double beyond : {field.min - step, field.max + step}) {
      Config config;
      char text[128];
      (void)std::snprintf(text, sizeof(text), "%s=%.17g", field.name, beyond);
      EXPECT_THROW(ApplySetting(text, config), Failure) << text;
    }
  });
}

TEST(FormatSettingsPage, EverySetting_HasARow) {
  const std::string page = FormatSettingsPage();
  const Config config;
  VisitFields(config, [&](const auto& field) {
    EXPECT_NE(page.find("| `" + std::string(field.name) + "` | "), std::string::npos) << field.name;
  });
}

}  // namespace
}  // namespace disflow::apps
