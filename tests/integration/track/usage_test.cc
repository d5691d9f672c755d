// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

#include "child_process.h"
#include "scratch_folder.h"

namespace disflow::test {
namespace {

constexpr const char* kSensor = "sim:bottle?frames=3";

/// A command line that cannot work and what the message must name.
struct Refusal {
  const char* name;
  Arguments arguments;
  int exit_status;
  const char* named;
};

void PrintTo(const Refusal& refusal, std::ostream* stream) { *stream << refusal.name; }

class RefusedCommandLine : public ScratchFolderTest, public testing::WithParamInterface<Refusal> {};

TEST_P(RefusedCommandLine, SaysWhatIsWrong) {
  const Refusal& refusal = GetParam();
  const Outcome outcome = RunTrack(refusal.arguments, scratch());
  EXPECT_EQ(outcome.exit_status, refusal.exit_status) << outcome.err;
  EXPECT_NE(outcome.err.find(refusal.named), std::string::npos) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    Usage, RefusedCommandLine,
    testing::Values(
        Refusal{"NoSensor", {}, 2, "--sensor"},
        Refusal{"UnknownOption", {"--sensor", kSensor, "--warp"}, 2, "--warp"},
        Refusal{"UnknownRate", {"--sensor", kSensor, "--rate", "brisk"}, 2, "--rate"},
        Refusal{"UnknownProfile", {"--sensor", kSensor, "--profile", "huge"}, 2, "--profile"},
        Refusal{"NoFrames", {"--sensor", kSensor, "--frames", "0"}, 2, "--frames"},
        Refusal{"ObjectIndexTooLarge", {"--sensor", kSensor, "--id", "43"}, 2, "--id"},
        Refusal{"SettingWithoutValue", {"--sensor", kSensor, "--set", "field"}, 2, "name=value"},
        Refusal{
            "SettingUnknown", {"--sensor", kSensor, "--set", "field.colour=1"}, 2, "field.colour"},
        Refusal{"SettingNoNumber",
                {"--sensor", kSensor, "--set", "registration.iterations=many"},
                2,
                "'many' is not a number"},
        Refusal{"SettingOutOfRange",
                {"--sensor", kSensor, "--set", "registration.iterations=51"},
                2,
                "1 to 50"},
        Refusal{"SettingNotWhole",
                {"--sensor", kSensor, "--set", "registration.iterations=2.5"},
                2,
                "whole number"},
        Refusal{"SettingsContradict",
                {"--sensor", kSensor, "--set", "segmenter.min_range_m=5"},
                2,
                "segmenter.max_range_m"},
        Refusal{"SettingsFileMissing",
                {"--sensor", kSensor, "--config", "/nonexistent/run.toml"},
                2,
                "/nonexistent/run.toml"},
        Refusal{"SensorWithoutScheme", {"--sensor", "bottle"}, 2, "bottle"},
        Refusal{"SensorUnknown", {"--sensor", "warp:drive"}, 2, "warp"},
        Refusal{"SequenceMissing",
                {"--sensor", "replay:/nonexistent/sequence"},
                3,
                "/nonexistent/sequence"},
        Refusal{"LinkUnknown", {"--sensor", kSensor, "--link", "tls://localhost:1"}, 2, "tls"},
        Refusal{"LinkDeviceMissing",
                {"--sensor", kSensor, "--link", "serial:///dev/nonexistent"},
                4,
                "/dev/nonexistent"},
        Refusal{"CsvFolderMissing",
                {"--sensor", kSensor, "--csv", "/nonexistent/run.csv"},
                4,
                "/nonexistent/run.csv"},
        Refusal{"MeshFolderMissing",
                {"--sensor", kSensor, "--mesh", "/nonexistent/run.ply"},
                4,
                "/nonexistent/run.ply"},
        Refusal{"MeshTooFine",
                {"--sensor", kSensor, "--mesh-resolution", "0.0001"},
                2,
                "--mesh-resolution"},
        Refusal{"FlowUnderFile",
                {"--sensor", kSensor, "--flow", "/dev/null/flow"},
                4,
                "/dev/null/flow"},
        Refusal{"MeshIsFolder", {"--sensor", kSensor, "--mesh", "/tmp"}, 4, "/tmp"},
        Refusal{"RecordingUnderFile",
                {"--sensor", kSensor, "--record", "/dev/null/run"},
                4,
                "/dev/null"},
        Refusal{"DiskFull", {"--sensor", kSensor, "--csv", "/dev/full"}, 4, "/dev/full"}),
    [](const testing::TestParamInfo<Refusal>& test) { return test.param.name; });

/// A settings file with one fault and what the message must name besides file and line 2.
struct FaultyFile {
  const char* name;
  const char* text;
  const char* named;
};

void PrintTo(const FaultyFile& file, std::ostream* stream) { *stream << file.name; }

class FaultySettingsFile : public ScratchFolderTest,
                           public testing::WithParamInterface<FaultyFile> {};

TEST_P(FaultySettingsFile, IsRefusedWithFileAndLine) {
  WriteFile(Path("run.toml"), GetParam().text);
  const Outcome outcome = RunTrack({"--sensor", kSensor, "--config", Path("run.toml")}, scratch());
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_NE(outcome.err.find("run.toml:2: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().named), std::string::npos) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    Usage, FaultySettingsFile,
    testing::Values(FaultyFile{"UnknownKey", "[field]\ncell_size = 0.1\n", "field.cell_size"},
                    FaultyFile{"UnknownSection", "[fields]\ncell_size_m = 0.1\n", "fields"},
                    FaultyFile{"KeyWithoutSection", "\ncell_size_m = 0.1\n", "cell_size_m"},
                    FaultyFile{"Text", "[field]\ncell_size_m = 'small'\n", "string"},
                    FaultyFile{"OutOfRange", "[field]\ncell_size_m = 3.0\n", "0.001 to 2 m"},
                    FaultyFile{"NotANumber", "[field]\ncell_size_m = nan\n", "out of range"},
                    FaultyFile{"NotWhole", "[field]\nfreeze_after = 1.5\n", "whole number"},
                    FaultyFile{"WholeWithAPoint", "[field]\nfreeze_after = 8.0\n",
                               "field.freeze_after = 8.0 is not a whole number"},
                    FaultyFile{"SectionAsAList", "\n[[run]]\nframes = 3\n",
                               "[[run]] is a list of sections; write [run]"},
                    FaultyFile{"List", "[field]\ncell_size_m = [1]\n", "is an array"},
                    FaultyFile{"Twice", "[field]\n[field]\n", "field"},
                    FaultyFile{"NoToml", "[field]\n[[[\n", "Error"}),
    [](const testing::TestParamInfo<FaultyFile>& test) { return test.param.name; });

class UsageTest : public ScratchFolderTest {};

TEST_F(UsageTest, EmptyValue_IsRefusedByTheOptionsName) {
  for (const char* option : {"--csv", "--mesh", "--record", "--flow", "--mesh-picture", "--config",
                             "--mask-stream", "--view", "--view-token", "--link", "--set"}) {
    const Outcome outcome = RunTrack({"--sensor", kSensor, option, ""}, scratch());
    EXPECT_EQ(outcome.exit_status, 2) << option;
    EXPECT_NE(outcome.err.find(option + std::string(": its value is empty")), std::string::npos)
        << outcome.err;
  }
  const Outcome outcome = RunSim({Path("out"), "--motion", ""}, scratch());
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_NE(outcome.err.find("--motion: its value is empty"), std::string::npos) << outcome.err;
}

TEST_F(UsageTest, OptionThatDoesNothingWithoutAnother_IsRefusedNamingBoth) {
  const std::pair<Arguments, const char*> cases[] = {
      {{"--camera-world", "ned"}, "--camera-world does nothing without --camera-pose"},
      {{"--camera-own-clock"}, "--camera-own-clock does nothing without --camera-pose"},
      {{"--view-hold"}, "--view-hold does nothing without --view"},
      {{"--view-token", "a-long-enough-token"}, "--view-token does nothing without --view"},
      {{"--mesh-resolution", "0.002"}, "--mesh-resolution does nothing without --mesh"}};
  for (const auto& [further, said] : cases) {
    Arguments arguments = {"--sensor", kSensor};
    arguments.insert(arguments.end(), further.begin(), further.end());
    const Outcome outcome = RunTrack(arguments, scratch());
    EXPECT_EQ(outcome.exit_status, 2) << said;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  }
  WriteFile(Path("run.toml"), "[run]\nview_hold = true\n");
  EXPECT_EQ(RunTrack({"--sensor", kSensor, "--config", Path("run.toml")}, scratch()).exit_status,
            2);
}

TEST_F(UsageTest, ResolutionOfZero_IsRefusedInAFewWords) {
  const Outcome outcome =
      RunTrack({"--sensor", kSensor, "--mesh", Path("a.ply"), "--mesh-resolution", "0"}, scratch());
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_NE(outcome.err.find("--mesh-resolution: 0 is no length"), std::string::npos)
      << outcome.err;
  EXPECT_LT(outcome.err.size(), 200U) << outcome.err;
}

TEST_F(UsageTest, FolderThatIsNoSequence_IsNotReplacedEvenWithForce) {
  std::filesystem::create_directories(Path("mine/gt"));
  WriteFile(Path("mine/gt/thesis.txt"), "mine");
  const Arguments sim = {Path("mine"), "--frames", "1", "--width", "64", "--height", "48"};
  Outcome outcome = RunSim(sim, scratch());
  EXPECT_EQ(outcome.exit_status, 4);
  EXPECT_NE(outcome.err.find("--force"), std::string::npos) << outcome.err;
  Arguments forced = sim;
  forced.emplace_back("--force");
  outcome = RunSim(forced, scratch());
  EXPECT_EQ(outcome.exit_status, 4);
  EXPECT_NE(outcome.err.find(Path("mine") + ": is no sequence"), std::string::npos) << outcome.err;
  EXPECT_EQ(ReadFile(Path("mine/gt/thesis.txt")), "mine");
  forced[0] = Path("sequence");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(RunSim(forced, scratch()).exit_status, 0) << i;
}

class SettingsTest : public ScratchFolderTest {};

TEST_F(SettingsTest, PrintedSettingsReadBack_AreTheSame) {
  const Outcome printed = RunTrack({"--print-config", "--set", "registration.iterations=11",
                                    "--set", "field.cell_size_m=0.0301"},
                                   scratch());
  ASSERT_EQ(printed.exit_status, 0) << printed.err;
  WriteFile(Path("run.toml"), printed.out);
  const Outcome again = RunTrack({"--print-config", "--config", Path("run.toml")}, scratch());
  EXPECT_EQ(again.exit_status, 0) << again.err;
  EXPECT_EQ(again.out, printed.out);
  EXPECT_NE(printed.out.find("\niterations = 11\n"), std::string::npos);
  EXPECT_NE(printed.out.find("\ncell_size_m = 0.0301\n"), std::string::npos);
}

TEST_F(SettingsTest, SetOnTheCommandLine_WinsOverTheFile) {
  WriteFile(Path("run.toml"), "[registration]\niterations = 9\n");
  const Outcome printed = RunTrack(
      {"--print-config", "--set", "registration.iterations=12", "--config", Path("run.toml")},
      scratch());
  EXPECT_NE(printed.out.find("\niterations = 12\n"), std::string::npos) << printed.out;
}

TEST_F(SettingsTest, DocumentedSettings_AreThoseOfTheProgram) {
  const Outcome page = RunTrack({"--print-settings-table"}, scratch());
  // Not EXPECT_EQ, which would print both pages.
  EXPECT_TRUE(ReadFile(DISFLOW_DOCS "/settings.md") == page.out)
      << "write it anew: disflow_track --print-settings-table > docs/settings.md";
}

TEST_F(SettingsTest, HelpAndVersion_AreAnswered) {
  const Outcome help = RunTrack({"--help"}, scratch());
  EXPECT_EQ(help.exit_status, 0);
  for (const char* option :
       {"--sensor", "--link", "--csv", "--mesh", "--mesh-resolution", "--mesh-picture", "--flow",
        "--config", "--rate", "--headless", "--record", "--profile", "--set", "--frames", "--id",
        "sim:", "replay:", "v4l2:", "--list-sensors"}) {
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  }
  const Outcome version = RunTrack({"--version"}, scratch());
  EXPECT_EQ(version.exit_status, 0);
  EXPECT_EQ(version.out.rfind("disflow_track ", 0), 0U) << version.out;
}

TEST_F(SettingsTest, HelpOfTheSimulator_NamesAllThatItTakes) {
  const Outcome help = RunSim({"--help"}, scratch());
  EXPECT_EQ(help.exit_status, 0);
  for (const char* word : {"--motion", "leaving", "--occluder", "curtain", "hand", "--support",
                           "table", "--drop", "--mask"}) {
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  }
}

/// Text of a camera file and what the message must name.
struct CameraFile {
  const char* text;
  const char* named;
};

class CameraFileTest : public ScratchFolderTest {};

TEST_F(CameraFileTest, FileThatIsNoCamera_IsRefusedWithLineAndKey) {
  const std::string good = "width = 320\nheight = 240\nfx = 300.0\nfy = 300.0\ncx = 160\n";
  const CameraFile cases[] = {{"", "cy is missing"},
                              {"cy = \"middle\"\n", ":6: cy"},
                              {"cy = nan\n", ":6: cy"},
                              {"cy = 120\ncolour = 1\n", ":7: colour"},
                              {"cy = 120\ndepth_scale = 0.0\n", ":7: depth_scale"},
                              {"cy = [1\n", ":"}};
  for (const CameraFile& one : cases) {
    WriteFile(Path("cam.toml"), good + one.text);
    const Outcome outcome =
        RunTrack({"--sensor", "v4l2:/dev/nowhere?intrinsics=" + Path("cam.toml")}, scratch());
    EXPECT_EQ(outcome.exit_status, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("cam.toml"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(one.named), std::string::npos) << outcome.err;
  }
}

TEST_F(CameraFileTest, LensThatDistorts_IsTakenOnceTheDriverIsSaidToRectify) {
  WriteFile(Path("cam.yaml"),
            "image_width: 320\nimage_height: 240\n"
            "camera_matrix: {data: [300, 0, 160, 0, 300, 120, 0, 0, 1]}\n"
            "distortion_coefficients: {data: [0.1, -0.2, 0, 0, 0]}\n"
            "projection_matrix: {data: [290, 0, 160, 0, 0, 290, 120, 0, 0, 0, 1, 0]}\n");
  const std::string sensor = "v4l2:/dev/nowhere?intrinsics=" + Path("cam.yaml");
  const Outcome refused = RunTrack({"--sensor", sensor}, scratch());
  EXPECT_EQ(refused.exit_status, 2) << refused.err;
  EXPECT_NE(refused.err.find("rectified=yes"), std::string::npos) << refused.err;
  // The file is read before the device is looked for.
  const Outcome taken = RunTrack({"--sensor", sensor + "&rectified=yes"}, scratch());
  EXPECT_EQ(taken.exit_status, 3) << taken.err;
  EXPECT_NE(taken.err.find("/dev/nowhere: no such device"), std::string::npos) << taken.err;
}

TEST_F(CameraFileTest, CameraThatIsNotThere_IsSaidAndListingSaysWhatIs) {
  WriteFile(Path("cam.toml"),
            "width = 320\nheight = 240\nfx = 300.0\nfy = 300.0\ncx = 160\ncy = 120\n");
  const Outcome outcome =
      RunTrack({"--sensor", "v4l2:/dev/nowhere?intrinsics=" + Path("cam.toml")}, scratch());
  EXPECT_EQ(outcome.exit_status, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("/dev/nowhere: no such device"), std::string::npos) << outcome.err;
  const Outcome list = RunTrack({"--list-sensors"}, scratch());
  EXPECT_EQ(list.exit_status, 0) << list.err;
  EXPECT_FALSE(list.out.empty());
}

}  // namespace
}  // namespace disflow::test
