// SPDX-License-Identifier: BSD-3-Clause
#include "report.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "errors.h"
#include "frame_table.h"
#include "plots.h"
#include "run_builder.h"
#include "scratch_dir.h"
#include "summary.h"
#include "text_file.h"

namespace disflow::apps {
namespace {

Report MakeReport(int frames = 20) {
  MadeUpRun made = MakeRun(frames);
  made.estimates.stage_names = {"total", "empty"};
  for (EstimateRow& row : made.estimates.rows) {
    row.stage_ms = {1.0 + row.frame, std::numeric_limits<double>::quiet_NaN()};
  }
  Report report;
  report.sequence = "a_sequence";
  report.csv = "run.csv";
  report.model = "model.obj";
  report.has_velocities = true;
  report.estimates = std::move(made.estimates);
  report.run = Align(made.truth, report.estimates);
  report.poses = EvaluatePoses(report.run, CuboidCorners());
  report.stages = EvaluateTiming(report.estimates);
  return report;
}

/// A report whose rows state a covariance, so that there are NEES.
Report MakeReportWithCovariance() {
  Report report = MakeReport();
  for (EstimateRow& row : report.estimates.rows) {
    row.pose_covariance = Mat6d::Identity();
    row.twist_covariance = Mat6d::Identity();
  }
  report.pose_consistency = EvaluatePoseConsistency(report.run);
  report.twist_consistency = EvaluateTwistConsistency(report.run);
  return report;
}

/// A PATH of the test's own, put back afterwards.
class PathGuard {
 public:
  explicit PathGuard(const std::string& path) : old_(std::getenv("PATH")) {
    ::setenv("PATH", path.c_str(), 1);
  }
  ~PathGuard() { ::setenv("PATH", old_.c_str(), 1); }
  PathGuard(const PathGuard&) = delete;
  PathGuard& operator=(const PathGuard&) = delete;

 private:
  std::string old_;
};

/// Puts a program called gnuplot that runs `body` into `dir` and returns a PATH that finds it.
std::string FakeGnuplot(const ScratchDir& dir, const std::string& body) {
  const auto program = dir.Write("bin/gnuplot", "#!/bin/sh\n" + body + "\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  return program.parent_path().string() + ":/usr/bin:/bin";
}

TEST(TimingTest, StagesWithNumbers_AreSummarisedAndEmptyOnesLeftOut) {
  const Report report = MakeReport();
  ASSERT_EQ(report.stages.size(), 1U);
  EXPECT_EQ(report.stages[0].name, "total");
  EXPECT_DOUBLE_EQ(report.stages[0].ms.median, 10.5);
  EXPECT_DOUBLE_EQ(report.stages[0].ms.max, 20.0);
}

TEST(ReportTest, Table_ShowsTheMainFigures) {
  const std::string table = FormatTable(MakeReport());
  for (const char* text : {"ADD-AUC, up to 0.10 m", "100.00 %", "final drift", "total"}) {
    EXPECT_NE(table.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(table.find("Surface"), std::string::npos);
}

TEST(ReportTest, Json_HoldsTheFiguresAndNoNan) {
  const auto json = nlohmann::json::parse(FormatJson(MakeReport()));
  EXPECT_NEAR(json["add_auc_percent"].get<double>(), 100.0, 1e-9);
  EXPECT_EQ(json["frames"]["sequence"], 20);
  EXPECT_EQ(json["frames"]["missing"], 0);
  EXPECT_DOUBLE_EQ(json["time_ms"]["total"]["max"].get<double>(), 20.0);
  EXPECT_FALSE(json.contains("surface"));
}

TEST(ReportTest, JsonOfASurfaceOfWhichNothingIsKnownToBeSeen_SaysNull) {
  Report report = MakeReport();
  report.surface.emplace();
  report.surface->seen_share = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(nlohmann::json::parse(FormatJson(report))["surface"]["seen_share"].is_null());
}

TEST(ReportTest, CalibrationOfASurface_IsShownAndInTheJson) {
  Report report = MakeReport();
  report.surface.emplace();
  SurfaceCalibration& c = report.surface_calibration.emplace();
  c.std_m = 0.0002;
  c.error_m = 0.0003;
  c.share_within = {0.5, 0.9, 0.99};
  c.bins = {{0.0001, 0.00015}};
  const auto json = nlohmann::json::parse(FormatJson(report))["surface"]["calibration"];
  EXPECT_NEAR(json["error_over_std"].get<double>(), 1.5, 1e-9);
  EXPECT_EQ(json["share_within_2_std"], 0.9);
  EXPECT_EQ(json["bins"][0]["error_m"], 0.00015);
  EXPECT_NE(FormatTable(report).find("50.0 / 90.0 / 99.0 %"), std::string::npos);
}

TEST(ReportTest, JsonOfAFileNameThatIsNoUtf8_IsStillJson) {
  Report report = MakeReport();
  report.sequence = "bad\xff name";
  EXPECT_TRUE(nlohmann::json::accept(FormatJson(report)));
}

TEST(SummaryTest, Links_AreRelativeAndCannotBreakOut) {
  Report report = MakeReport();
  report.sequence = "a|b](x)";
  const std::string page =
      FormatSummary(report, {{"errors.png", "Errors"}}, "/out", "/out/my plots(1)");
  EXPECT_NE(page.find("![Errors](my%20plots%281%29/errors.png)"), std::string::npos) << page;
  EXPECT_NE(page.find("a\\|b\\]\\(x\\)"), std::string::npos) << page;
}

TEST(SummaryTest, PageInTheCurrentFolder_LinksFromThere) {
  // "s.md" has no folder in its name.
  const std::string page = FormatSummary(MakeReport(), {{"errors.png", "Errors"}}, "", "plots");
  EXPECT_NE(page.find("![Errors](plots/errors.png)"), std::string::npos) << page;
  const std::string beside = FormatSummary(MakeReport(), {{"errors.png", "Errors"}}, "", "");
  EXPECT_NE(beside.find("![Errors](errors.png)"), std::string::npos) << beside;
}

TEST(PlotsTest, EveryPlot_IsWrittenEvenIntoAFolderWithAStrangeName) {
  const ScratchDir dir;
  const PathGuard path(
      FakeGnuplot(dir, "grep -o \"output '[^']*\" plots.gp | cut -d\"'\" -f2 | xargs touch"));
  const auto folder = dir.path() / "a 'quoted'; $(touch hacked) \"name\"";
  const std::vector<Plot> plots = WritePlots(MakeReport(), folder);
  EXPECT_EQ(plots.size(), 4U);
  for (const Plot& plot : plots) EXPECT_TRUE(std::filesystem::exists(folder / plot.file));
  EXPECT_FALSE(std::filesystem::exists(dir.path() / "hacked"));
  EXPECT_EQ(ReadFile(folder / "plots.gp").find("quoted"), std::string::npos);
}

TEST(PlotsTest, ReportWithCovariances_HasAPlotOfTheNees) {
  const ScratchDir dir;
  const PathGuard path(FakeGnuplot(dir, "exit 0"));
  const std::vector<Plot> plots = WritePlots(MakeReportWithCovariance(), dir.path());
  EXPECT_EQ(std::count_if(plots.begin(), plots.end(),
                          [](const Plot& plot) { return plot.file == "nees.png"; }),
            1);
}

TEST(FrameTableTest, EveryFrame_HasItsLineAndWhatIsNotKnownIsNan) {
  const std::string text = FormatFrames(MakeReportWithCovariance());
  std::vector<Line> lines;
  LineReader reader(text);
  for (Line line; reader.Next(line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 21U);
  const auto names = SplitAt(lines[0].text, ',');
  const auto nees = std::find(names.begin(), names.end(), "pose_nees") - names.begin();
  const auto column = static_cast<std::size_t>(nees);
  EXPECT_EQ(SplitAt(lines[1].text, ',')[column], "nan") << "the aligned frame is exact";
  for (std::size_t i = 2; i < lines.size(); ++i) {
    const auto fields = SplitAt(lines[i].text, ',');
    ASSERT_EQ(fields.size(), names.size());
    EXPECT_EQ(ParseNumber(fields[0]), static_cast<double>(i - 1));
    EXPECT_LT(ParseNumber(fields[column]).value_or(1.0), 1e-9);
  }
}

TEST(PlotsTest, MissingFrames_LeaveAGapInTheData) {
  const ScratchDir dir;
  const PathGuard path(FakeGnuplot(dir, "exit 0"));
  Report report = MakeReport();
  report.poses.frames.erase(report.poses.frames.begin() + 7);
  report.run.frames.erase(report.run.frames.begin() + 7);
  (void)WritePlots(report, dir.path());
  EXPECT_NE(ReadFile(dir.path() / "frames.dat").find("\n\n"), std::string::npos);
}

TEST(PlotsTest, GnuplotMissing_IsSaidAndItsInputKept) {
  const ScratchDir dir;
  const PathGuard path("/nonexistent");
  const std::string message =
      MessageOf<OutputError>([&] { (void)WritePlots(MakeReport(), dir.path()); });
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "gnuplot is not installed", message);
  EXPECT_TRUE(std::filesystem::exists(dir.path() / "plots.gp"));
}

TEST(PlotsTest, GnuplotFailing_IsSaid) {
  const ScratchDir dir;
  const PathGuard path(FakeGnuplot(dir, "exit 3"));
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "gnuplot failed",
                      MessageOf<OutputError>([&] { (void)WritePlots(MakeReport(), dir.path()); }));
}

TEST(PlotsTest, FolderThatCannotBe_IsAnOutputError) {
  const ScratchDir dir;
  const auto file = dir.Write("file", "x");
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "cannot be created", MessageOf<OutputError>([&] {
                        (void)WritePlots(MakeReport(), file / "plots");
                      }));
}

TEST(WriteFileTest, Link_StaysAndLeadsToWhatWasWritten) {
  const ScratchDir dir;
  const std::filesystem::path file = dir.Write("real.json", "earlier");
  std::filesystem::create_symlink("real.json", dir.path() / "link.json");
  WriteFile(dir.path() / "link.json", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(dir.path() / "link.json"));
  EXPECT_EQ(ReadFile(file), "new");
}

TEST(WriteFileTest, FileThatTheProgramWasStartedWith_GoesOnAndKeepsWhatIsInIt) {
  const ScratchDir dir;
  const std::filesystem::path file = dir.Write("log", "earlier\n");
  const int log = ::open(file.c_str(), O_WRONLY | O_APPEND);
  ASSERT_GE(log, 0);
  const std::string name = "/proc/self/fd/" + std::to_string(log);
  WriteFile(name, "first\n");
  WriteFile(name, "second\n");
  EXPECT_EQ(::close(log), 0);
  EXPECT_EQ(ReadFile(file), "earlier\nfirst\nsecond\n");
  EXPECT_THROW(WriteFile("/proc/self/fd/4095", "lost"), OutputError);
}

TEST(WriteFileTest, ReplacesWhatWasThere) {
  const ScratchDir dir;
  const auto file = dir.Write("out.json", "old and longer");
  WriteFile(file, "new");
  EXPECT_EQ(ReadFile(file), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 1);
}

TEST(WriteFileTest, UnwritablePlace_IsAnOutputErrorThatNamesTheFile) {
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "/nonexistent/out.json",
                      MessageOf<OutputError>([] { WriteFile("/nonexistent/out.json", "text"); }));
}

TEST(WriteFileTest, FullDisk_IsAnOutputError) {
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "/dev/full",
                      MessageOf<OutputError>([] { WriteFile("/dev/full", "text"); }));
}

}  // namespace
}  // namespace disflow::apps
