// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "child_process.h"
#include "estimate_csv.h"
#include "evaluation.h"
#include "scratch_folder.h"

namespace disflow::test {
namespace {

namespace fs = std::filesystem;

class SeveralObjectsTest : public ScratchFolderTest {
 protected:
  /// Two objects in a simulated stream, with a trajectory and a mesh each.
  [[nodiscard]] Outcome Track(const std::string& run, const std::string& sensor,
                              const Arguments& more = {}) const {
    Arguments arguments = {"--sensor",   sensor,
                           "--object",   "name=box,label=1",
                           "--object",   "name=bottle,label=2",
                           "--csv",      Path(run + ".csv"),
                           "--headless", "--no-timing"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunTrack(arguments, scratch());
  }
  [[nodiscard]] std::string Csv(const std::string& run, const std::string& object) const {
    return ReadFile(Path(run + "-" + object + ".csv"));
  }
};

constexpr const char* kTwo = "sim:box+bottle?noise=white&frames=60";

TEST_F(SeveralObjectsTest, AnyNumberOfThreads_GivesTheSameBytes) {
  for (const char* threads : {"1", "2", "4"}) {
    const Outcome outcome =
        Track(threads, kTwo, {"--threads", threads, "--mesh", Path(std::string(threads) + ".ply")});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  }
  for (const char* object : {"box", "bottle"}) {
    EXPECT_FALSE(Csv("1", object).empty());
    for (const char* threads : {"2", "4"}) {
      EXPECT_EQ(Csv("1", object), Csv(threads, object));
      EXPECT_EQ(ReadFile(Path(std::string("1-") + object + ".ply")),
                ReadFile(Path(std::string(threads) + "-" + object + ".ply")));
    }
  }
  EXPECT_NE(Csv("1", "box"), Csv("1", "bottle"));
}

TEST_F(SeveralObjectsTest, EachIsTrackedAsWellAsIfItWereAlone) {
  const std::string address = "sim:box+bottle?frames=120";
  ASSERT_EQ(Track("run", address).exit_status, 0);
  for (const char* object : {"box", "bottle"}) {
    const apps::Report report = apps::Evaluate({.sequence = address,
                                                .csv = Path(std::string("run-") + object + ".csv"),
                                                .model = {},
                                                .mesh = {},
                                                .object = object});
    EXPECT_GE(report.poses.add_auc, 0.95) << object;
  }
}

TEST_F(SeveralObjectsTest, HiddenOne_LeavesTheBytesOfTheOthersAsTheyAre) {
  // The farther one, so that the pixels of the nearer are the same.
  ASSERT_EQ(Track("usual", "sim:box+bottle?frames=80").exit_status, 0);
  ASSERT_EQ(Track("hidden", "sim:box+bottle?frames=80&hide=2").exit_status, 0);
  EXPECT_EQ(Csv("usual", "box"), Csv("hidden", "box"));
  EXPECT_NE(Csv("usual", "bottle"), Csv("hidden", "bottle"));
  EXPECT_NE(Csv("hidden", "bottle").find("empty_mask"), std::string::npos);
}

TEST_F(SeveralObjectsTest, RecordedMasksOfEach_GiveTheSameAsTheSimulation) {
  ASSERT_EQ(
      RunSim({Path("sequence"), "--object", "box+bottle", "--noise", "white", "--frames", "60"},
             scratch())
          .exit_status,
      0);
  ASSERT_EQ(Track("replayed", "replay:" + Path("sequence") + "?object=box+bottle").exit_status, 0);
  ASSERT_EQ(Track("simulated", kTwo).exit_status, 0);
  for (const char* object : {"box", "bottle"}) {
    EXPECT_EQ(Csv("replayed", object), Csv("simulated", object));
    const apps::Report report =
        apps::Evaluate({.sequence = Path("sequence"),
                        .csv = Path(std::string("replayed-") + object + ".csv"),
                        .model = {},
                        .mesh = {},
                        .object = object});
    EXPECT_GE(report.poses.add_auc, 0.9) << object;
  }
}

TEST_F(SeveralObjectsTest, RecordedLabels_ReplayToTheSameTrajectories) {
  ASSERT_EQ(Track("live", kTwo, {"--record", Path("recorded")}).exit_status, 0);
  ASSERT_EQ(Track("again", "replay:" + Path("recorded")).exit_status, 0);
  for (const char* object : {"box", "bottle"}) EXPECT_EQ(Csv("live", object), Csv("again", object));
}

TEST_F(SeveralObjectsTest, SettingsFile_GivesEachItsOwnSettings) {
  WriteFile(Path("run.toml"), "object = [\n]\n");
  EXPECT_EQ(RunTrack({"--config", Path("run.toml"), "--sensor", kTwo, "--frames", "1"}, scratch())
                .exit_status,
            0)
      << "an empty list is none";
  WriteFile(Path("run.toml"),
            "[run]\nsensor = \"" + std::string(kTwo) + "\"\nheadless = true\ncsv = \"" +
                Path("all.csv") +
                "\"\n[segmenter]\nmax_range_m = 3.0\n"
                "[[object]]\nname = \"near\"\nlabel = 1\n[object.segmenter]\nmax_range_m = 0.3\n"
                "[[object]]\nname = \"far\"\nlabel = 2\ncsv = \"" +
                Path("mine.csv") + "\"\n");
  const Outcome outcome = RunTrack({"--config", Path("run.toml")}, scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("near: no frame could be tracked"), std::string::npos) << outcome.err;
  EXPECT_EQ(ReadFile(Path("all-near.csv")).find(",ok,"), std::string::npos)
      << "all of it is out of its own range";
  EXPECT_NE(ReadFile(Path("mine.csv")).find(",ok,"), std::string::npos);
  EXPECT_FALSE(fs::exists(Path("all-far.csv")));
}

TEST_F(SeveralObjectsTest, SeedsInPlaceOfMasks_TrackEachItsOwn) {
  const std::string sensor = "sim:box+bottle?frames=20&mask=none";
  const Outcome one = RunTrack(
      {"--sensor", sensor, "--headless", "--no-timing", "--object", "name=left,roi=0:0:320:360",
       "--object", "name=right,roi=320:0:320:360", "--csv", Path("run.csv")},
      scratch());
  ASSERT_EQ(one.exit_status, 0) << one.err;
  const auto left = apps::LoadEstimates(Path("run-left.csv"), 20);
  const auto right = apps::LoadEstimates(Path("run-right.csv"), 20);
  EXPECT_LT(left.rows.back().T_co.translation().x(), right.rows.back().T_co.translation().x());
}

TEST_F(SeveralObjectsTest, OneNamedObject_IsTrackedAsWithoutItsName) {
  const Arguments common = {"--sensor", "sim:box?frames=30", "--headless", "--no-timing"};
  Arguments plain = common;
  plain.insert(plain.end(), {"--csv", Path("plain.csv")});
  Arguments named = common;
  named.insert(named.end(), {"--csv", Path("named.csv"), "--object", "name=box"});
  ASSERT_EQ(RunTrack(plain, scratch()).exit_status, 0);
  ASSERT_EQ(RunTrack(named, scratch()).exit_status, 0);
  EXPECT_EQ(ReadFile(Path("plain.csv")), ReadFile(Path("named.csv")));
}

/// Wrong use and a part of what is said of it.
struct WrongUse {
  const char* name;
  Arguments objects;
  const char* said;
};

void PrintTo(const WrongUse& wrong, std::ostream* stream) { *stream << wrong.name; }

class WrongObjects : public ScratchFolderTest, public testing::WithParamInterface<WrongUse> {};

TEST_P(WrongObjects, AreRefusedBySayingWhy) {
  Arguments arguments = {"--sensor", "sim:box+bottle?frames=3", "--csv", Path("run.csv")};
  for (const std::string& object : GetParam().objects) {
    arguments.emplace_back("--object");
    arguments.push_back(object);
  }
  const Outcome outcome = RunTrack(arguments, scratch());
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, GetParam().said, outcome.err);
  EXPECT_TRUE(fs::is_empty(scratch()) || !fs::exists(Path("run-a.csv")));
}

INSTANTIATE_TEST_SUITE_P(
    Usage, WrongObjects,
    testing::Values(
        WrongUse{"SameName", {"name=a,label=1", "name=a,label=2"}, "two objects are called a"},
        WrongUse{"SameLabel", {"name=a,label=1", "name=b,label=1"}, "same mask label 1"},
        WrongUse{"SameStart", {"name=a", "name=b"}, "would be the same object"},
        WrongUse{"SameSeed", {"name=a,seed=5:5", "name=b,seed=5:5"}, "would be the same object"},
        WrongUse{"SameIndex", {"name=a,label=1,index=1", "name=b,label=2"}, "same index 1"},
        WrongUse{"SameFile", {"name=a,label=1,csv=x", "name=b,label=2,csv=x"}, "both write x"},
        WrongUse{"TooMany",
                 {"name=a,label=1", "name=b,label=2", "name=c,label=3", "name=d,label=4",
                  "name=e,label=5"},
                 "5 objects are too many; 4 have room"},
        WrongUse{"LabelZero", {"name=a,label=0"}, "from 1 to 255"},
        WrongUse{"LabelTooLarge", {"name=a,label=256"}, "from 1 to 255"},
        WrongUse{"IndexTooLarge", {"name=a,index=43"}, "from 0 to 42"},
        WrongUse{"NoName", {"label=1"}, "has no name"},
        WrongUse{"NameThatIsNone", {"name=../a"}, "is no name for an object"},
        WrongUse{"UnknownKey", {"name=a,colour=red"}, "has no 'colour'"},
        WrongUse{"HalfASeed", {"name=a,seed=5"}, "U:V"},
        WrongUse{"NoKey", {"box"}, "is not key=value"}),
    [](const testing::TestParamInfo<WrongUse>& test) { return test.param.name; });

}  // namespace
}  // namespace disflow::test
