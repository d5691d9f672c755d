// SPDX-License-Identifier: BSD-3-Clause
#include "files/output_names.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "program/exit_status.h"
#include "refusal.h"
#include "scratch_folder.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

class OutputNamesTest : public test::ScratchFolderTest {
 protected:
  OutputNamesTest() : options_() { options_.objects.resize(1); }

  ObjectFiles& files(std::size_t object = 0) { return options_.objects[object].files; }
  [[nodiscard]] std::string Refusal() const {
    return RefusalOf([&] { RefuseSharedOutputs(options_); });
  }

  Options options_;
};

TEST_F(OutputNamesTest, NamesOfTheirOwn_AreAccepted) {
  files() = {Path("a.csv"), Path("a.ply"), Path("a.png"), Path("flow/")};
  options_.record = Path("record");
  EXPECT_EQ(Refusal(), "");
}

TEST_F(OutputNamesTest, OneNameForTwoOutputs_IsRefusedNamingBothOptions) {
  files().csv = files().mesh = Path("run");
  EXPECT_EQ(Refusal(),
            "--csv and --mesh would both write " + Path("run") + "; give each a name of its own");
}

TEST_F(OutputNamesTest, EveryPairOfOutputs_IsCompared) {
  std::string* const names[] = {&files().csv, &files().mesh, &files().mesh_picture, &files().flow,
                                &options_.record};
  for (std::string* const a : names) {
    for (std::string* const b : names) {
      if (a == b) continue;
      *a = *b = Path("same");
      EXPECT_NE(Refusal(), "");
      a->clear();
      b->clear();
    }
  }
}

TEST_F(OutputNamesTest, OtherSpellings_AreSeenThrough) {
  fs::create_directory(Path("folder"));
  for (const char* spelling : {"./run", "folder/../run", ".//run", "run/"}) {
    files().csv = Path("run");
    files().mesh = Path(spelling);
    EXPECT_NE(Refusal(), "") << spelling;
  }
  // Relative to the current folder.
  files().csv = "run";
  files().mesh = (fs::current_path() / "run").string();
  EXPECT_NE(Refusal(), "");
  files().mesh = "./run";
  EXPECT_NE(Refusal(), "");
}

TEST_F(OutputNamesTest, Links_AreSeenThrough) {
  fs::create_symlink("run.csv", Path("to_nothing_yet"));
  files().csv = Path("run.csv");
  files().mesh = Path("to_nothing_yet");
  EXPECT_NE(Refusal(), "") << "a link to a file that the run will create";

  test::WriteFile(Path("old.csv"), "old");
  fs::create_hard_link(Path("old.csv"), Path("hard"));
  files().csv = Path("old.csv");
  files().mesh = Path("hard");
  EXPECT_NE(Refusal(), "") << "a hard link";

  fs::create_directory(Path("folder"));
  fs::create_directory_symlink("folder", Path("other"));
  files().csv = Path("folder/run.csv");
  files().mesh = Path("other/run.csv");
  EXPECT_NE(Refusal(), "") << "a link to the folder";
}

TEST_F(OutputNamesTest, LinksThatGoRound_EndSomewhere) {
  fs::create_symlink(Path("b"), Path("a"));
  fs::create_symlink(Path("a"), Path("b"));
  files().csv = Path("a");
  files().mesh = Path("c");
  EXPECT_EQ(Refusal(), "");  // opening it says what is wrong
}

TEST_F(OutputNamesTest, FilesOfSeveralObjects_AreComparedToo) {
  options_.objects.resize(2);
  options_.objects[0].name = "box";
  options_.objects[1].name = "can";
  files(0).csv = Path("x");
  files(1).csv = Path("x");
  EXPECT_NE(Refusal().find("--csv of the object box and --csv of the object can"),
            std::string::npos);
  files(1).csv = Path("y");
  EXPECT_EQ(Refusal(), "");
  files(1).mesh = Path("x");
  EXPECT_NE(Refusal(), "");
}

TEST_F(OutputNamesTest, NameOfAMeshThatIsNotCompleteYet_IsTaken) {
  files().mesh = Path("run.ply");
  files().csv = Path("run.ply.part");
  EXPECT_NE(Refusal(), "");
}

TEST_F(OutputNamesTest, OutputThatIsAnInput_IsRefusedNamingBoth) {
  files().csv = Path("run.toml");
  options_.settings_files = {Path("run.toml")};
  EXPECT_EQ(Refusal(), "--csv " + Path("run.toml") +
                           " would overwrite an input, the settings file " + Path("run.toml") +
                           "; give it a name of its own");
  options_.settings_files.clear();
  EXPECT_EQ(Refusal(), "");
  test::WriteFile(Path("run.toml"), "an OBJ, a recording, a key");
  for (const std::string& sensor :
       {"sim:box+obj:" + Path("run.toml") + "?frames=3", "rosbag:" + Path("run.toml"),
        Path("run.toml") + "?depth=/depth", "v4l2:/dev/video0?intrinsics=" + Path("run.toml")}) {
    options_.sensor = sensor;
    EXPECT_NE(Refusal().find("would overwrite an input, --sensor "), std::string::npos) << sensor;
  }
  options_.sensor = "sim:box";
  options_.mask_stream = "file:" + Path("./run.toml");
  EXPECT_NE(Refusal().find("--mask-stream"), std::string::npos);
  options_.mask_stream.clear();
  options_.links = {"udp://localhost:1?key=" + Path("run.toml")};
  EXPECT_NE(Refusal().find("--link"), std::string::npos);
}

TEST_F(OutputNamesTest, FilesOfTheRecordingThatIsReplayed_AreRefusedAndOthersBesideThemNot) {
  fs::create_directories(Path("seq/depth"));
  fs::create_directories(Path("seq/gt"));
  test::WriteFile(Path("seq/data.txt"), "");
  options_.sensor = "replay:" + Path("seq") + "?mask=none";
  for (const char* name : {"seq/data.txt", "seq/gt/poses.txt", "seq/depth/0.float", "seq/depth"}) {
    files().csv = Path(name);
    EXPECT_NE(Refusal().find(Path("seq")), std::string::npos) << name;
  }
  files().csv = Path("seq/run.csv");
  EXPECT_EQ(Refusal(), "");
}

TEST_F(OutputNamesTest, Pipe_TakesAnyNumberOfOutputs) {
  ASSERT_EQ(::mkfifo(Path("pipe").c_str(), 0600), 0);
  files().csv = files().mesh = Path("pipe");
  EXPECT_EQ(Refusal(), "");
  // As /dev/stdout is one when another program reads from this.
  int ends[2] = {};
  ASSERT_EQ(::pipe(ends), 0);
  files().csv = files().mesh = "/proc/self/fd/" + std::to_string(ends[1]);
  EXPECT_EQ(Refusal(), "");
  EXPECT_EQ(::close(ends[0]) + ::close(ends[1]), 0);
}

TEST_F(OutputNamesTest, NullDevice_TakesAnyNumberOfOutputs) {
  files().csv = files().mesh = files().mesh_picture = "/dev/null";
  EXPECT_EQ(Refusal(), "");
}

}  // namespace
}  // namespace disflow::apps
