// SPDX-License-Identifier: BSD-3-Clause
#include "files/output_names.h"

#include <gtest/gtest.h>

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

TEST_F(OutputNamesTest, NullDevice_TakesAnyNumberOfOutputs) {
  files().csv = files().mesh = files().mesh_picture = "/dev/null";
  EXPECT_EQ(Refusal(), "");
}

}  // namespace
}  // namespace disflow::apps
