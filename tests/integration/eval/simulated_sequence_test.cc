// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "child_process.h"
#include "endless_run.h"
#include "scratch_folder.h"

namespace disflow::test {
namespace {

class SimulatedSequence : public ScratchFolderTest {};

/// Everything of the printed table but the names of files and the times.
std::string Figures(const std::string& table) {
  return table.substr(0, table.find("Time per frame"));
}

/// The model's file has rounded coordinates: the last digit may differ.
void ExpectSameFigures(const std::string& a, const std::string& b) {
  std::istringstream words_a(a);
  std::istringstream words_b(b);
  std::string word_a;
  std::string word_b;
  while (words_a >> word_a) {
    ASSERT_TRUE(words_b >> word_b) << "after " << word_a;
    char* end = nullptr;
    const double value = std::strtod(word_a.c_str(), &end);
    if (end == word_a.c_str()) {
      ASSERT_EQ(word_a, word_b);
    } else {
      ASSERT_NEAR(value, std::strtod(word_b.c_str(), nullptr), 0.011) << a << b;
    }
  }
  EXPECT_FALSE(words_b >> word_b) << word_b;
}

TEST_F(SimulatedSequence, JudgedByItsAddress_HasTheFiguresOfItsFiles) {
  constexpr const char* kAddress =
      "sim:bottle?motion=fast&noise=white&seed=4&frames=20&drop=0.2&width=320&height=180";
  ASSERT_EQ(RunTrack({"--sensor", kAddress, "--csv", Path("run.csv"), "--mesh", Path("run.ply"),
                      "--headless"},
                     scratch())
                .exit_status,
            0);
  ASSERT_EQ(
      RunSim({Path("files"), "--object", "bottle", "--motion", "fast", "--noise", "white", "--seed",
              "4", "--frames", "20", "--drop", "0.2", "--width", "320", "--height", "180"},
             scratch())
          .exit_status,
      0);
  std::string figures[2];
  int i = 0;
  for (const std::string& sequence : {std::string(kAddress), Path("files")}) {
    const Outcome outcome = ChildProcess(DISFLOW_EVAL,
                                         {sequence, "--csv", Path("run.csv"), "--mesh",
                                          Path("run.ply"), "--frames", Path("frames.csv")},
                                         scratch())
                                .Wait();
    ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
    figures[i++] = Figures(outcome.out);
  }
  ExpectSameFigures(figures[0], figures[1]);
  const std::string frames = ReadFile(Path("frames.csv"));
  const auto lines = std::count(frames.begin(), frames.end(), '\n');
  EXPECT_GT(lines, 10);
  EXPECT_LT(lines, 21) << "dropped frames have no line";
}

/// A short sequence in "files" and its trajectory and surface.
class JudgedSequence : public SimulatedSequence {
 protected:
  void SetUp() override {
    ASSERT_EQ(
        RunSim({Path("files"), "--frames", "5", "--width", "320", "--height", "180"}, scratch())
            .exit_status,
        0);
    ASSERT_EQ(RunTrack({"--sensor", "replay:" + Path("files"), "--csv", Path("run.csv"), "--mesh",
                        Path("run.ply"), "--headless"},
                       scratch())
                  .exit_status,
              0);
  }
  [[nodiscard]] Outcome Judge(const Arguments& further) const {
    Arguments arguments = {Path("files"), "--csv", Path("run.csv"), "--mesh", Path("run.ply")};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return ChildProcess(DISFLOW_EVAL, arguments, scratch()).Wait();
  }
};

TEST_F(JudgedSequence, OutputThatIsAnInput_IsRefusedNamingBothAndLeavesItAsItWas) {
  std::filesystem::copy_file(Path("run.csv"), Path("other.csv"));
  std::filesystem::create_symlink("run.csv", Path("link.csv"));
  for (const auto& [output, input] : {std::pair{"run.csv", "--csv"},
                                      {"link.csv", "--csv"},
                                      {"run.ply", "--mesh"},
                                      {"other.csv", "--compare"},
                                      {"files/gt/poses.txt", "SEQUENCE"},
                                      {"files/data.txt", "SEQUENCE"},
                                      {"files/gt/model.obj", "SEQUENCE"}}) {
    const std::string before = ReadFile(Path(output));
    const Outcome outcome = Judge({"--compare", Path("other.csv"), "--json", Path(output)});
    EXPECT_EQ(outcome.exit_status, 2) << output << outcome.err;
    EXPECT_NE(outcome.err.find("--json " + Path(output) + " would overwrite an input, " + input),
              std::string::npos)
        << outcome.err;
    EXPECT_TRUE(ReadFile(Path(output)) == before) << output;
  }
}

TEST_F(JudgedSequence, OneNameForTwoOutputs_IsRefusedBeforeAnythingIsWritten) {
  const Outcome outcome = Judge({"--json", Path("out"), "--tum", Path("out")});
  EXPECT_EQ(outcome.exit_status, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("--tum and --json would both write " + Path("out")), std::string::npos)
      << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(Path("out")));
  EXPECT_EQ(Judge({"--json", "/dev/null", "--tum", "/dev/null"}).exit_status, 0);
  // Beside the sequence's own files there is room for results, the second time as well.
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(Judge({"--json", Path("files/run.json")}).exit_status, 0) << i;
}

TEST_F(JudgedSequence, EmptyValue_IsRefusedByTheOptionsName) {
  for (const char* option : {"--json", "--frames", "--plots", "--summary", "--tum", "--tum-truth",
                             "--bop", "--latex", "--model"}) {
    const Outcome outcome = Judge({option, ""});
    EXPECT_EQ(outcome.exit_status, 2) << option;
    EXPECT_NE(outcome.err.find(option + std::string(": its value is empty")), std::string::npos)
        << outcome.err;
  }
}

TEST_F(SimulatedSequence, CutShortByAKill_IsEvaluatedAsFarAsItGoes) {
  ChildProcess simulator(DISFLOW_SIM, {Path("cut"), "--object", "bottle", "--frames", "30000"},
                         scratch());
  AwaitLines(Path("cut/data.txt"), 10);
  simulator.Signal(SIGKILL);
  ASSERT_EQ(simulator.Wait().exit_status, -SIGKILL);
  const Outcome track = RunTrack(
      {"--sensor", "replay:" + Path("cut"), "--csv", Path("run.csv"), "--headless"}, scratch());
  ASSERT_EQ(track.exit_status, 0) << track.err;
  const Outcome outcome =
      ChildProcess(DISFLOW_EVAL, {Path("cut"), "--csv", Path("run.csv")}, scratch()).Wait();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
}

TEST_F(SimulatedSequence, TruthOfAFrameThatWasNotWritten_IsLeftOutWithAWord) {
  ASSERT_EQ(RunSim({Path("cut"), "--object", "bottle", "--frames", "12"}, scratch()).exit_status,
            0);
  const std::filesystem::path stamps = Path("cut/data.txt");
  std::filesystem::resize_file(stamps, std::filesystem::file_size(stamps) - 3);
  ASSERT_EQ(RunTrack({"--sensor", "replay:" + Path("cut"), "--csv", Path("run.csv"), "--headless"},
                     scratch())
                .exit_status,
            0);
  const Outcome outcome =
      ChildProcess(DISFLOW_EVAL, {Path("cut"), "--csv", Path("run.csv")}, scratch()).Wait();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("the sequence was cut short; left out: the end of"), std::string::npos)
      << outcome.err;
}

TEST_F(SimulatedSequence, NoisySurface_KnowsHowFarOffItIs) {
  constexpr const char* kAddress = "sim:bottle?motion=rotate360&noise=white&seed=2&frames=120";
  ASSERT_EQ(RunTrack({"--sensor", kAddress, "--csv", Path("run.csv"), "--mesh", Path("run.ply"),
                      "--headless"},
                     scratch())
                .exit_status,
            0);
  const Outcome outcome = ChildProcess(DISFLOW_EVAL,
                                       {kAddress, "--csv", Path("run.csv"), "--mesh",
                                        Path("run.ply"), "--json", Path("run.json")},
                                       scratch())
                              .Wait();
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  const auto surface = nlohmann::json::parse(ReadFile(Path("run.json")))["surface"];
  EXPECT_GT(surface["seen"]["f_1mm"].get<double>(), 0.9);
  EXPECT_GT(surface["seen"]["f_2mm"].get<double>(), 0.97);
  EXPECT_LT(surface["seen"]["chamfer_m"].get<double>(), 0.0005);
  const auto calibration = surface["calibration"];
  EXPECT_GT(calibration["error_over_std"].get<double>(), 0.5);
  EXPECT_LT(calibration["error_over_std"].get<double>(), 2.0);
  EXPECT_GT(calibration["share_within_2_std"].get<double>(), 0.8);
  EXPECT_GT(calibration["share_within_3_std"].get<double>(), 0.9);
  // Where it says so it is worse.
  const auto& bins = calibration["bins"];
  EXPECT_GT(bins.back()["error_m"].get<double>(), 1.5 * bins.front()["error_m"].get<double>());
}

}  // namespace
}  // namespace disflow::test
