// SPDX-License-Identifier: BSD-3-Clause
#include "settings/ros_parameter_file.h"

#include <gtest/gtest.h>

#include "parsed.h"
#include "refusal.h"
#include "scratch_folder.h"
#include "settings/options.h"

namespace disflow::apps {
namespace {

/// Refused, and named with its line.
struct Wrong {
  const char* text;
  const char* line;
  const char* named;
};

class RosParameterFileTest : public test::ScratchFolderTest {
 protected:
  /// What the program makes of the file.
  Options Parse(const std::string& file, std::vector<std::string> arguments = {}) {
    test::WriteFile(Path("params.yaml"), file);
    arguments.insert(arguments.begin(),
                     {"--sensor", "sim:box", "--ros-args", "--params-file", Path("params.yaml")});
    return Parsed(std::move(arguments));
  }
};

TEST_F(RosParameterFileTest, NestedAndDottedNames_SayTheSame) {
  for (const char* const text :
       {"/**:\n  ros__parameters:\n    registration:\n      iterations: 12\n",
        "/**/disflow:\n  ros__parameters:\n    registration.iterations: 12\n",
        "disflow:\n  ros__parameters:\n    registration.iterations: 12\n",
        "/disflow:\n  ros__parameters: {object: {registration.iterations: 12}}\n",
        "/disflow:\n  ros__parameters:\n    object.registration.iterations: 12\n"}) {
    EXPECT_EQ(Parse(text).objects.at(0).config.registration.iterations, 12) << text;
  }
}

TEST_F(RosParameterFileTest, OptionsOfTheCommandLine_AreTakenUnlessTheyWereTyped) {
  const std::string file =
      "/**:\n  ros__parameters:\n    use_sim_time: false\n    run:\n      rate: realtime\n"
      "      headless: true\n      range: [0.2, 1.5]\n      frames: 30\n";
  const Options options = Parse(file, {"--frames", "7"});
  EXPECT_EQ(options.rate, Rate::kRealtime);
  EXPECT_TRUE(options.headless);
  EXPECT_EQ(options.objects.at(0).config.segmenter.max_range_m, 1.5F);
  EXPECT_EQ(options.frames, 7);
  EXPECT_EQ(options.settings_files, std::vector{Path("params.yaml")}) << "SIGHUP reads it again";
}

// A launch file's Node hands over one for each entry of its parameters.
TEST_F(RosParameterFileTest, OfSeveralFiles_TheLastWordCountsAndOthersNodesMayHaveTheirOwn) {
  const std::string head = "/**:\n  ros__parameters:\n";
  test::WriteFile(Path("camera.yaml"), "camera:\n  ros__parameters: {exposure: 3}\n");
  test::WriteFile(Path("over.yaml"),
                  head + "    registration.iterations: 12\n    run.frames: 30\n");
  const Options options =
      Parse(head + "    registration.iterations: 9\n    sampler.border_px: 3\n    run.frames: 7\n",
            {"--params-file", Path("camera.yaml"), "--params-file", Path("over.yaml")});
  EXPECT_EQ(options.objects.at(0).config.registration.iterations, 12);
  EXPECT_EQ(options.objects.at(0).config.sampler.border_px, 3);
  EXPECT_EQ(options.frames, 30);
  const std::vector<std::string> read = {Path("params.yaml"), Path("camera.yaml"),
                                         Path("over.yaml")};
  EXPECT_EQ(options.settings_files, read) << "SIGHUP reads all of them again";
}

TEST_F(RosParameterFileTest, SeveralFiles_AreRefusedWhereNoneIsOfTheNodeAndByTheOneThatIsWrong) {
  test::WriteFile(Path("more.yaml"), "lens:\n  ros__parameters: {a: 1}\n");
  const std::vector<std::string> more = {"--params-file", Path("more.yaml")};
  const std::string none =
      RefusalOf([&] { (void)Parse("camera:\n  ros__parameters: {a: 1}\n", more); });
  EXPECT_TRUE(none.starts_with(Path("params.yaml") + ", " + Path("more.yaml") + ": ")) << none;
  test::WriteFile(Path("more.yaml"), "/**:\n  ros__parameters: {a: 1}\n");
  const std::string wrong = RefusalOf(
      [&] { (void)Parse("/**:\n  ros__parameters: {registration.iterations: 9}\n", more); });
  EXPECT_TRUE(wrong.starts_with(Path("more.yaml") + ":2: ")) << wrong;
}

TEST_F(RosParameterFileTest, SeveralObjects_HaveTheirOwnAndWhatWasTypedWins) {
  const std::string file =
      "/**:\n  ros__parameters:\n    registration.iterations: 9\n"
      "    cup: {registration: {iterations: 12}, segmenter.min_range_m: 0.3}\n";
  const std::vector<std::string> objects = {"--object", "name=box,label=1", "--object",
                                            "name=cup,label=2"};
  const Options options = Parse(file, objects);
  EXPECT_EQ(options.objects.at(0).config.registration.iterations, 9);
  EXPECT_EQ(options.objects.at(1).config.registration.iterations, 12);
  EXPECT_EQ(options.objects.at(1).config.segmenter.min_range_m, 0.3F);
  std::vector<std::string> typed = objects;
  typed.insert(typed.end(), {"--set", "registration.iterations=4"});
  for (const ObjectOptions& object : Parse(file, typed).objects)
    EXPECT_EQ(object.config.registration.iterations, 4);
}

TEST_F(RosParameterFileTest, NodesOfOtherNames_ArePassedOverAndTheLastWordCounts) {
  const std::string file =
      "camera:\n  ros__parameters: {exposure: 3}\n"
      "/**:\n  ros__parameters: {registration.iterations: 9}\n"
      "eye:\n  ros__parameters: {registration.iterations: 12}\n"
      "disflow:\n  ros__parameters: {registration.iterations: 5}\n";
  EXPECT_EQ(Parse(file).objects.at(0).config.registration.iterations, 5);
  const Options eye = Parse(file, {"--link", "dds:domain=3&name=eye"});
  EXPECT_EQ(eye.objects.at(0).config.registration.iterations, 12);
}

TEST_F(RosParameterFileTest, WhatIsWrong_IsNamedWithFileLineAndParameter) {
  const std::string head = "/**:\n  ros__parameters:\n";
  for (const auto& [text, line, named] :
       {Wrong{"    registration.iterations: 99\n", ":3: ", "iterations = 99 is out of range"},
        Wrong{"    registration:\n      iterations: 1.5\n", ":4: ", "not a whole number"},
        Wrong{"    registration.iterations: \"12\"\n", ":3: ", "iterations is no number"},
        Wrong{"    registration.iterations: [1, 2]\n", ":3: ", "iterations is no number"},
        Wrong{"    registration.iteration: 12\n", ":3: ", "no setting registration.iteration"},
        Wrong{"    object.registration.iterations: 99\n", ":3: ", "out of range"},
        Wrong{"    cup.registration.iterations: 12\n", ":3: ", "no object cup"},
        Wrong{"    iterations: 12\n", ":3: ", "no parameter iterations"},
        Wrong{"    run.speed: 12\n", ":3: ", "no option --speed"},
        Wrong{"    run.config: x\n", ":3: ", "no option --config"},
        Wrong{"    run.rate: quick\n", ":3: ", "quick"},
        Wrong{"    run: {rate: {a: 1}}\n", ":3: ", "no option --rate.a"},
        Wrong{"    a: [1\n", ":4: ", ""}}) {
    const std::string said = RefusalOf([&, text = text] { (void)Parse(head + text); });
    EXPECT_TRUE(said.starts_with(Path("params.yaml") + line)) << text << said;
    EXPECT_NE(said.find(named), std::string::npos) << text << said;
  }
}

TEST_F(RosParameterFileTest, FilesThatSayNothingOfTheNode_AreRefused) {
  for (const auto& [text, named] :
       {std::pair("", "holds no node"),
        std::pair("camera:\n  ros__parameters: {a: 1}\n", "disflow:"),
        std::pair("/**:\n  registration.iterations: 9\n", "ros__parameters"),
        std::pair("/**:\n  ros__parameters: 9\n", "ros__parameters")}) {
    const std::string said = RefusalOf([&, text = text] { (void)Parse(text); });
    EXPECT_NE(said.find(named), std::string::npos) << said;
  }
  const std::string both = RefusalOf([&] { (void)Parse("", {"--config", Path("run.toml")}); });
  EXPECT_NE(both.find("not both"), std::string::npos) << both;
}

TEST_F(RosParameterFileTest, AliasesThatMultiply_EndAtOnce) {
  std::string text = "a0: &a0 {x: 1, y: 1, z: 1}\n";
  for (int i = 1; i < 6; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " {";
    for (int k = 0; k < 9; ++k) text += "k" + std::to_string(k) + ": " + before + ", ";
    text += "}\n";
  }
  Config config;
  const std::vector<std::string> bomb = {Path("bomb.yaml")};
  test::WriteFile(bomb[0], text + "/**:\n  ros__parameters: {use_sim_time: 0, run: *a5}\n");
  EXPECT_FALSE(RefusalOf([&] { (void)LoadRosParameters(bomb, "/disflow", config); }).empty());
}

}  // namespace
}  // namespace disflow::apps
