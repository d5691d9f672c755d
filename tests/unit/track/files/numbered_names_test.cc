// SPDX-License-Identifier: BSD-3-Clause
#include "files/numbered_names.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "refusal.h"
#include "scratch_folder.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

class NumberedNamesTest : public test::ScratchFolderTest {
 protected:
  NumberedNamesTest() : options_() { options_.objects.resize(1); }

  [[nodiscard]] std::string NumberedRecord(const std::string& name) {
    options_.record = name;
    return NumberOutputs(options_).record;
  }

  Options options_;
};

TEST_F(NumberedNamesTest, NamesWithoutTheMark_StayAsTheyAre) {
  options_.record = Path("a{b}c");
  options_.objects[0].files = {"run.csv", "x/y.ply", "", "flow/"};
  const Options numbered = NumberOutputs(options_);
  EXPECT_EQ(numbered.record, options_.record);
  EXPECT_EQ(numbered.objects[0].files.csv, "run.csv");
  EXPECT_EQ(numbered.objects[0].files.mesh, "x/y.ply");
  EXPECT_EQ(numbered.objects[0].files.flow, "flow/");
}

TEST_F(NumberedNamesTest, EveryStart_GetsANameThatNothingHas) {
  for (int start = 1; start <= 3; ++start) {
    const std::string name = NumberedRecord(Path("{n}"));
    EXPECT_EQ(name, Path("00000" + std::to_string(start)));
    ASSERT_TRUE(fs::create_directory(name));
  }
}

TEST_F(NumberedNamesTest, FolderThatIsNotThereYet_StartsWithOne) {
  EXPECT_EQ(NumberedRecord(Path("none/yet/{n}/")), Path("none/yet/000001"));
  EXPECT_FALSE(fs::exists(Path("none")));
}

TEST_F(NumberedNamesTest, AllOutputs_GetOneNumberThatNoneOfThemHas) {
  test::WriteFile(Path("run-000004.csv"), "");
  test::WriteFile(Path("000002"), "");
  options_.objects.resize(2);
  options_.objects[0].files = {Path("run-{n}.csv"), Path("{n}.ply"), Path("{n}.png"),
                               Path("flow-{n}/")};
  options_.objects[1].files.csv = Path("run-{n}-can.csv");
  options_.record = Path("{n}");
  const Options numbered = NumberOutputs(options_);
  EXPECT_EQ(numbered.record, Path("000005"));
  EXPECT_EQ(numbered.objects[0].files.csv, Path("run-000005.csv"));
  EXPECT_EQ(numbered.objects[0].files.mesh, Path("000005.ply"));
  EXPECT_EQ(numbered.objects[0].files.mesh_picture, Path("000005.png"));
  EXPECT_EQ(numbered.objects[0].files.flow, Path("flow-000005"));
  EXPECT_EQ(numbered.objects[1].files.csv, Path("run-000005-can.csv"));
}

TEST_F(NumberedNamesTest, GapsAreNotFilled_SoThatNumbersSortByTime) {
  fs::create_directory(Path("000007"));
  EXPECT_EQ(NumberedRecord(Path("{n}")), Path("000008"));
}

TEST_F(NumberedNamesTest, SixDigitsUsedUp_GoOnWithSeven) {
  fs::create_directory(Path("run999999"));
  EXPECT_EQ(NumberedRecord(Path("run{n}")), Path("run1000000"));
  fs::create_directory(Path("run1000000"));
  EXPECT_EQ(NumberedRecord(Path("run{n}")), Path("run1000001"));
}

TEST_F(NumberedNamesTest, OtherNames_AreNoNumbers) {
  for (const char* name : {"run-7.csv", "run-000009.txt", "ran-000009.csv", "run-.csv", "run-",
                           "run-00000x.csv", "run--00009.csv", "run-99999999999999999999.csv"})
    test::WriteFile(Path(name), "");
  options_.objects[0].files.csv = Path("run-{n}.csv");
  EXPECT_EQ(NumberOutputs(options_).objects[0].files.csv, Path("run-000001.csv"));
}

TEST_F(NumberedNamesTest, MarkElsewhereThanOnceInTheLastPart_IsRefusedByName) {
  for (const char* name : {"{n}/run", "{n}-{n}", "{n}/{n}"}) {
    options_.record = Path(name);
    const std::string refusal = RefusalOf([&] { (void)NumberOutputs(options_); });
    EXPECT_EQ(refusal.find(Path(name)), 0U) << refusal;
    EXPECT_NE(refusal.find("last part"), std::string::npos) << refusal;
  }
}

TEST_F(NumberedNamesTest, FolderThatCannotBeRead_IsNamed) {
  test::WriteFile(Path("file"), "");
  options_.record = Path("file/{n}");
  const std::string refusal = RefusalOf([&] { (void)NumberOutputs(options_); }, kOutputFailed);
  EXPECT_EQ(refusal.find(Path("file") + ": cannot be read"), 0U) << refusal;
}

TEST_F(NumberedNamesTest, OldOutputs_AreRemovedBeyondTheCountAndNothingElse) {
  for (const char* name :
       {"run-000001.csv", "run-000002.csv", "run-000003.csv", "run-000003.csv.bak",
        "run-000001.csv.bak", "run-1.csv", "run-x.csv", "run-000001.ply"})
    test::WriteFile(Path(name), "x");
  for (const char* folder : {"rec-000001", "rec-000002", "rec-000004", "rec-000000"}) {
    fs::create_directories(fs::path(Path(folder)) / "depth");
    test::WriteFile(Path(std::string(folder) + "/data.txt"), "x");
    test::WriteFile(Path(std::string(folder) + "/cam_K.json"), "x");
  }
  test::WriteFile(Path("rec-000002/notes.txt"), "mine");
  options_.objects[0].files.csv = Path("run-{n}.csv");
  options_.objects[0].files.mesh = Path("run-{n}.ply");
  options_.record = Path("rec-{n}");
  RemoveOldOutputs(options_, 2);
  std::set<std::string> left;
  for (const auto& entry : fs::directory_iterator(scratch()))
    left.insert(entry.path().filename().string());
  EXPECT_EQ(left, (std::set<std::string>{
                      "run-000003.csv", "run-000003.csv.bak", "run-000001.csv.bak", "run-1.csv",
                      "run-x.csv", "run-000001.ply", "rec-000002", "rec-000004", "rec-000000"}));
  // What somebody else has put there stays.
  EXPECT_EQ(test::ReadFile(Path("rec-000002/notes.txt")), "mine");
  EXPECT_FALSE(fs::exists(Path("rec-000002/depth")));
  EXPECT_TRUE(fs::exists(Path("rec-000004/depth")));
}

TEST_F(NumberedNamesTest, FolderOfSuchANameThatIsNoRecording_IsLeftAlone) {
  fs::create_directories(Path("rec-000001/depth"));
  test::WriteFile(Path("rec-000001/depth/mine"), "mine");
  fs::create_directory(Path("rec-000002"));
  options_.record = Path("rec-{n}");
  RemoveOldOutputs(options_, 1);
  EXPECT_EQ(test::ReadFile(Path("rec-000001/depth/mine")), "mine");
}

TEST_F(NumberedNamesTest, LinkInPlaceOfARecording_IsRemovedAndNotFollowed) {
  fs::create_directories(Path("elsewhere/depth"));
  test::WriteFile(Path("elsewhere/data.txt"), "x");
  fs::create_directory_symlink(Path("elsewhere"), Path("rec-000001"));
  fs::create_directory(Path("rec-000002"));
  options_.record = Path("rec-{n}");
  RemoveOldOutputs(options_, 1);
  EXPECT_FALSE(fs::exists(fs::symlink_status(Path("rec-000001"))));
  EXPECT_TRUE(fs::exists(Path("elsewhere/data.txt")));
}

}  // namespace
}  // namespace disflow::apps
