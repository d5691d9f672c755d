// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "parsed.h"
#include "program/exit_status.h"
#include "refusal.h"
#include "scratch_folder.h"
#include "settings/options.h"

namespace disflow::apps {
namespace {

class CommandLineTest : public test::ScratchFolderTest {
 protected:
  static Options Parse(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"--sensor", "sim:box"});
    return Parsed(std::move(arguments));
  }
  /// With the settings file.
  Options ParseWith(const std::string& file, std::vector<std::string> arguments) {
    test::WriteFile(Path("run.toml"), file);
    arguments.insert(arguments.begin(), {"--config", Path("run.toml")});
    return Parsed(std::move(arguments));
  }
  static std::string Refusal(const std::vector<std::string>& arguments) {
    return RefusalOf([&] { (void)Parse(arguments); });
  }
};

TEST_F(CommandLineTest, NothingAsked_IsOneObjectWithTheDefaults) {
  const Options options = Parse({});
  ASSERT_EQ(options.objects.size(), 1U);
  EXPECT_EQ(options.objects[0].name, "object");
  EXPECT_TRUE(options.objects[0].uses_mask);
  EXPECT_EQ(options.rate, Rate::kMax);
  EXPECT_EQ(options.frames, 0);
  EXPECT_TRUE(options.timing);
}

TEST_F(CommandLineTest, FileThenShortFormsThenSet_TheLastWins) {
  const std::string file = "[segmenter]\nseed_u_px = 1\nseed_v_px = 2\nmax_range_m = 3.0\n";
  const auto segmenter = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--sensor", "sim:box"});
    return ParseWith(file, std::move(arguments)).objects[0].config.segmenter;
  };
  EXPECT_EQ(segmenter({}).seed_u_px, 1);
  EXPECT_EQ(segmenter({"--seed", "5,6"}).seed_u_px, 5);
  EXPECT_EQ(segmenter({"--seed", "5,6", "--set", "segmenter.seed_u_px=9"}).seed_u_px, 9);
  EXPECT_EQ(segmenter({"--seed", "5,6", "--set", "segmenter.seed_u_px=9"}).seed_v_px, 6);
  EXPECT_EQ(segmenter({"--seed", "5,6"}).max_range_m, 3.0F);
}

TEST_F(CommandLineTest, OptionsOfTheFile_CountUnlessTheyAreTyped) {
  const std::string file =
      "[run]\nsensor = 'sim:bottle'\nframes = 7\nrate = 'realtime'\nheadless = true\n"
      "no_timing = false\nlink = ['udp://localhost:1', 'udp://localhost:2']\n";
  const Options untouched = ParseWith(file, {});
  EXPECT_EQ(untouched.sensor, "sim:bottle");
  EXPECT_EQ(untouched.frames, 7);
  EXPECT_EQ(untouched.rate, Rate::kRealtime);
  EXPECT_TRUE(untouched.headless);
  EXPECT_TRUE(untouched.timing) << "no_timing = false leaves it on";
  EXPECT_EQ(untouched.links.size(), 2U);
  const Options typed =
      ParseWith(file, {"--frames", "3", "--sensor", "sim:box", "--link", "udp://localhost:3"});
  EXPECT_EQ(typed.sensor, "sim:box");
  EXPECT_EQ(typed.frames, 3);
  EXPECT_EQ(typed.links, std::vector<std::string>{"udp://localhost:3"});
  EXPECT_EQ(typed.rate, Rate::kRealtime);
}

TEST_F(CommandLineTest, TypedSettings_ReachTheObjectsOfTheFile) {
  const std::string file =
      "[run]\nsensor = 'sim:box'\n[[object]]\nname = 'a'\nlabel = 1\n"
      "[object.registration]\niterations = 5\n[[object]]\nname = 'b'\nlabel = 2\n";
  Options options = ParseWith(file, {});
  ASSERT_EQ(options.objects.size(), 2U);
  EXPECT_EQ(options.objects[0].config.registration.iterations, 5);
  options = ParseWith(file, {"--set", "registration.iterations=8"});
  for (const ObjectOptions& object : options.objects)
    EXPECT_EQ(object.config.registration.iterations, 8);
}

TEST_F(CommandLineTest, TypedObjects_TakeThePlaceOfThoseInTheFile) {
  const Options options =
      ParseWith("[[object]]\nname = 'a'\nlabel = 1\n[[object]]\nname = 'b'\nlabel = 2\n",
                {"--sensor", "sim:box", "--object", "name=c"});
  ASSERT_EQ(options.objects.size(), 1U);
  EXPECT_EQ(options.objects[0].name, "c");
}

TEST_F(CommandLineTest, LinkToRos_IsKeptApartFromThoseThatCarryMavlink) {
  const Options options = Parse(
      {"--link", "udp://localhost:1", "--link", "dds:domain=3", "--link", "udp://localhost:2"});
  EXPECT_EQ(options.dds_link, "dds:domain=3");
  EXPECT_EQ(options.links, (std::vector<std::string>{"udp://localhost:1", "udp://localhost:2"}));
}

TEST_F(CommandLineTest, OptionsThatContradict_AreRefusedNamingThem) {
  EXPECT_NE(Refusal({"--link", "dds:domain=0", "--link", "dds:domain=1"}).find("dds:"),
            std::string::npos);
  EXPECT_NE(Refusal({"--link", "dds:mask=/m", "--mask-stream", "/m"}).find("--mask-stream"),
            std::string::npos);
  EXPECT_NE(Refusal({"--camera-pose", "1"}).find("--link"), std::string::npos);
  EXPECT_NE(
      Refusal({"--camera-pose", "1", "--link", "udp://localhost:1", "--link", "dds:world=map"})
          .find("dds:world="),
      std::string::npos);
  EXPECT_NE(Refusal({"--camera-pose", "5", "--link", "udp://localhost:1", "--camera-in-body",
                     "0,0,0,1,1,0,0"})
                .find("quaternion"),
            std::string::npos);
  EXPECT_NE(Refusal({"--camera-pose", "5", "--link", "udp://localhost:1", "--camera-in-body",
                     "0,0,nan,1,0,0,0"})
                .find("--camera-in-body"),
            std::string::npos);
  EXPECT_NE(Refusal({"--seed", "1,2", "--object", "name=a,label=1", "--object", "name=b,label=2"})
                .find("--seed"),
            std::string::npos);
}

TEST_F(CommandLineTest, NumbersWithoutSense_AreRefused) {
  for (const auto& [option, value] :
       std::vector<std::pair<std::string, std::string>>{{"--frames", "-1"},
                                                        {"--frames", "1.5"},
                                                        {"--frames", "99999999999999999999"},
                                                        {"--threads", "0"},
                                                        {"--threads", "5"},
                                                        {"--mask-age", "-0.1"},
                                                        {"--mask-age", "nan"},
                                                        {"--roi", "1,2,3"},
                                                        {"--roi", "1,2,3,4,5"},
                                                        {"--range", "1"},
                                                        {"--seed", "1"},
                                                        {"--seed", "a,b"},
                                                        {"--id", "-1"},
                                                        {"--id", "300"},
                                                        {"--camera-pose", "256"},
                                                        {"--rt-priority", "99"},
                                                        {"--mesh-resolution", "0"},
                                                        {"--mesh-resolution", "nan"}}) {
    EXPECT_NE(Refusal({option, value}), "") << option << " " << value;
  }
}

}  // namespace
}  // namespace disflow::apps
