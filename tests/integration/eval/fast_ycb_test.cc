// SPDX-License-Identifier: BSD-3-Clause
#include "fast_ycb.h"

#include <gtest/gtest.h>

#include "child_process.h"
#include "scratch_folder.h"

namespace disflow::test {
namespace {

namespace fs = std::filesystem;
using testing::IsSubstring;

/// A small simulated set in the layout of the public one.
class FastYcb : public ScratchFolderTest {
 protected:
  void Simulate(const std::string& name, const std::string& object, int frames = 12) {
    const Outcome outcome =
        RunSim({Path("data/" + name), "--object", object, "--motion", "moderate", "--frames",
                std::to_string(frames), "--width", "320", "--height", "180", "--mask", "gt,sloppy"},
               scratch());
    ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
    fs::rename(Path("data/" + name + "/masks/sloppy"),
               Path("data/" + name + "/masks/mrcnn_ycbv_bop_pbr"));
  }
  Outcome Judge(const Arguments& more = {}) {
    Arguments words = {"--fast-ycb", Path("data"), "--out", Path("out")};
    words.insert(words.end(), more.begin(), more.end());
    return ChildProcess(DISFLOW_EVAL, words, scratch()).Wait();
  }
};

/// The line of a table that begins with `name`.
std::string Row(const std::string& text, const std::string& name) {
  const std::size_t begin = text.find("| " + name);
  return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
}

TEST_F(FastYcb, SequencesThatAreThere_StandBesideThePublishedFigures) {
  Simulate("003_cracker_box", "box");
  Simulate("006_mustard_bottle", "bottle");
  const Outcome outcome = Judge();
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(ReadFile(Path("out/tables.md")), outcome.out);
  for (const char* text : {"Table I: pose, 003_cracker_box", "Table II: pose, 006_mustard_bottle",
                           "Table III: velocity", "Table IV: surface"}) {
    EXPECT_PRED_FORMAT2(IsSubstring, text, outcome.out);
  }
  const std::string auc = Row(outcome.out, "ADD-AUC %");
  const std::string published = "| ADD-AUC % | 54.92 | 78.5 | 68.94 | 63.02 | 92.44 | ";
  ASSERT_EQ(auc.substr(0, published.size()), published);
  EXPECT_GT(std::stod(auc.substr(published.size())), 90.0) << auc;
  // Both mask sets of both objects, and nothing made up for the others.
  for (const char* row : {"003_cracker_box, gt", "003_cracker_box, mrcnn_ycbv_bop_pbr",
                          "006_mustard_bottle, gt", "006_mustard_bottle, mrcnn_ycbv_bop_pbr"}) {
    EXPECT_FALSE(Row(outcome.out, row).empty()) << row;
  }
  EXPECT_EQ(outcome.out.find("004_sugar_box"), std::string::npos);
  EXPECT_PRED_FORMAT2(IsSubstring, "004_sugar_box: skipped", outcome.err);
  EXPECT_TRUE(fs::exists(Path("out/006_mustard_bottle-gt.ply")));
}

TEST_F(FastYcb, WhatIsMissing_IsNamedAndSkipped) {
  Simulate("006_mustard_bottle", "bottle");
  Simulate("004_sugar_box", "box", 2);
  fs::remove(Path("data/004_sugar_box/gt/model.obj"));
  fs::remove_all(Path("data/006_mustard_bottle/masks/mrcnn_ycbv_bop_pbr"));
  fs::create_directories(Path("models"));
  fs::rename(Path("data/006_mustard_bottle/gt/model.obj"), Path("models/006_mustard_bottle.obj"));
  const Outcome outcome = Judge({"--models", Path("models")});
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_PRED_FORMAT2(IsSubstring, "004_sugar_box: skipped, no model", outcome.err);
  EXPECT_PRED_FORMAT2(IsSubstring, "006_mustard_bottle, masks mrcnn_ycbv_bop_pbr: skipped",
                      outcome.err);
  EXPECT_FALSE(Row(outcome.out, "006_mustard_bottle, gt").empty());
}

TEST_F(FastYcb, FolderWithoutAnySequence_IsRefused) {
  fs::create_directories(Path("data"));
  const Outcome outcome = Judge();
  EXPECT_EQ(outcome.exit_status, 3);
  EXPECT_PRED_FORMAT2(IsSubstring, "holds no sequence", outcome.err);
}

TEST_F(FastYcb, SequenceAndWholeSetAtOnce_IsWrongUsage) {
  EXPECT_EQ(Judge({"sim:box", "--csv", "x.csv"}).exit_status, 2);
}

TEST(FastYcbTables, FiguresThatAreNotKnown_AreDashes) {
  const std::vector<apps::FastYcbResult> results = {{.object = "003_cracker_box",
                                                     .mask = "gt",
                                                     .add_auc_percent = 97.25,
                                                     .linear_cmps = std::nan(""),
                                                     .surface = std::nullopt}};
  const std::string page = apps::FormatFastYcb(results);
  EXPECT_PRED_FORMAT2(IsSubstring, "| 92.44 | 97.25 | – |", page);
  EXPECT_PRED_FORMAT2(IsSubstring, "| 5.237 | 2.311 | – | – |", page);
}

}  // namespace
}  // namespace disflow::test
