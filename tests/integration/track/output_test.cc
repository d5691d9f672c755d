// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "child_process.h"
#include "endless_run.h"
#include "estimate_csv.h"
#include "model_file.h"
#include "ply_file.h"
#include "resource_limit.h"
#include "scratch_folder.h"

namespace disflow::test {
namespace {

namespace fs = std::filesystem;

using OutputTest = ScratchFolderTest;

class StopSignal : public OutputTest, public testing::WithParamInterface<int> {};

TEST_P(StopSignal, EndsTheRunWithEverythingWritten) {
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", kEndlessSensor, "--csv", Path("run.csv"), "--mesh",
                      Path("run.ply"), "--record", Path("recorded")},
                     scratch());
  AwaitLines(Path("run.csv"), 10);
  track.Signal(GetParam());
  const Outcome outcome = track.Wait();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(ReadFile(Path("run.csv")).back(), '\n');
  const std::size_t rows = apps::LoadEstimates(Path("run.csv"), 30000).rows.size();
  EXPECT_GE(rows, 9U);
  EXPECT_NE(outcome.err.find(std::to_string(rows) + " frames"), std::string::npos) << outcome.err;
  EXPECT_FALSE(apps::LoadPly(Path("run.ply")).vertices.empty());

  const Outcome replay =
      RunTrack({"--sensor", "replay:" + Path("recorded"), "--csv", Path("again.csv")}, scratch());
  EXPECT_EQ(replay.exit_status, 0) << replay.err;
  EXPECT_EQ(apps::LoadEstimates(Path("again.csv"), 30000).rows.size(), rows);
}

INSTANTIATE_TEST_SUITE_P(Output, StopSignal, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const testing::TestParamInfo<int>& test) {
                           return std::string(test.param == SIGINT    ? "Interrupt"
                                              : test.param == SIGTERM ? "Terminate"
                                                                      : "HangUp");
                         });

TEST_F(OutputTest, FailedStart_LeavesEarlierResultsAlone) {
  WriteFile(Path("run.csv"), "earlier\n");
  WriteFile(Path("run.ply"), "earlier\n");
  const Outcome no_input = RunTrack(
      {"--sensor", "replay:/nonexistent", "--csv", Path("run.csv"), "--mesh", Path("run.ply")},
      scratch());
  EXPECT_EQ(no_input.exit_status, 3) << no_input.err;
  const Outcome outcome = RunTrack({"--sensor", "sim:bottle?frames=3", "--csv", Path("run.csv"),
                                    "--mesh", "/nonexistent/run.ply"},
                                   scratch());
  EXPECT_EQ(outcome.exit_status, 4) << outcome.err;
  EXPECT_EQ(ReadFile(Path("run.csv")), "earlier\n");
  EXPECT_EQ(ReadFile(Path("run.ply")), "earlier\n");
}

TEST_F(OutputTest, OneNameForTwoOutputs_IsRefusedAndNothingIsTouched) {
  WriteFile(Path("run"), "earlier\n");
  fs::create_hard_link(Path("run"), Path("other"));
  for (const char* other : {"run", "./run", "other"}) {
    const Outcome outcome =
        RunTrack({"--sensor", "sim:bottle?frames=3", "--csv", Path("run"), "--mesh", Path(other)},
                 scratch());
    EXPECT_EQ(outcome.exit_status, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("--csv and --mesh"), std::string::npos) << outcome.err;
    EXPECT_EQ(ReadFile(Path("run")), "earlier\n");
  }
}

class PipeTest : public OutputTest {
 protected:
  PipeTest() { EXPECT_EQ(::mkfifo(Path("pipe").c_str(), 0600), 0); }
};

TEST_F(PipeTest, NobodyReads_FirstStopSignalEndsTheProgramWithAMessage) {
  ChildProcess track(
      DISFLOW_TRACK,
      {"--sensor", kEndlessSensor, "--headless", "--csv", Path("pipe"), "--flow", Path("flow")},
      scratch());
  // Made before the trajectory is opened: by then the program takes signals.
  for (int i = 0; i < 3000 && !fs::exists(Path("flow")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  track.Signal(SIGTERM);
  const Outcome outcome = track.Wait();
  EXPECT_EQ(outcome.exit_status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("pipe: stopped while waiting"), std::string::npos) << outcome.err;
}

TEST_F(PipeTest, ReaderThatStopsReading_DoesNotOutlastAStopSignal) {
  const int reader = ::open(Path("pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  ASSERT_GE(::fcntl(reader, F_SETPIPE_SZ, 4096), 0);  // room for the header and a row or two
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", kEndlessSensor, "--headless", "--csv", Path("pipe")}, scratch());
  // It is being written, and nobody takes anything out.
  int waiting = 0;
  for (int i = 0; i < 3000 && waiting < 2000; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_EQ(::ioctl(reader, FIONREAD, &waiting), 0);
  }
  ASSERT_GE(waiting, 2000);
  track.Signal(SIGTERM);
  const Outcome outcome = track.Wait();
  EXPECT_GE(outcome.exit_status, 0) << "ended by itself: " << outcome.err;
  ::close(reader);
}

TEST_F(PipeTest, ReaderThatGoesAway_IsSaidAndTheOtherOutputsAreComplete) {
  const int reader = ::open(Path("pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", "sim:bottle?frames=20", "--headless", "--csv", Path("pipe"),
                      "--mesh", Path("run.ply")},
                     scratch());
  int waiting = 0;
  for (int i = 0; i < 3000 && waiting == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_EQ(::ioctl(reader, FIONREAD, &waiting), 0);
  }
  ::close(reader);
  const Outcome outcome = track.Wait();
  EXPECT_EQ(outcome.exit_status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("pipe: cannot be written: Broken pipe"), std::string::npos)
      << outcome.err;
  EXPECT_FALSE(apps::LoadPly(Path("run.ply")).vertices.empty());
}

TEST_F(OutputTest, DiskFullWhileRunning_KeepsWholeRowsAndSaysSo) {
  Outcome outcome;
  {
    const ResourceLimit limit(RLIMIT_FSIZE, 10000);
    outcome = RunTrack({"--sensor", "sim:bottle?frames=40", "--csv", Path("run.csv")}, scratch());
  }
  EXPECT_EQ(outcome.exit_status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("run.csv: cannot be written"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("40 frames"), std::string::npos)
      << "tracking goes on: " << outcome.err;
  const std::string text = ReadFile(Path("run.csv"));
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(text.back(), '\n');
  EXPECT_GE(apps::LoadEstimates(Path("run.csv"), 40).rows.size(), 3U);
}

TEST_F(OutputTest, DiskFullForTheMesh_KeepsTheEarlierMesh) {
  WriteFile(Path("run.ply"), "earlier\n");
  Outcome outcome;
  {
    const ResourceLimit limit(RLIMIT_FSIZE, 10000);
    outcome = RunTrack({"--sensor", "sim:bottle?frames=5", "--mesh", Path("run.ply")}, scratch());
  }
  EXPECT_EQ(outcome.exit_status, 4) << outcome.err;
  EXPECT_EQ(ReadFile(Path("run.ply")), "earlier\n");
}

TEST_F(OutputTest, Mesh_HasUnitNormalsAndAnUncertaintyAtEveryVertex) {
  const Outcome outcome =
      RunTrack({"--sensor", "sim:bottle?frames=10", "--mesh", Path("run.ply")}, scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  const std::string ply = ReadFile(Path("run.ply"));
  EXPECT_EQ(ply.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0U);
  EXPECT_NE(ply.find("property float std_m\n"), std::string::npos);
  const auto mesh = apps::LoadPly(Path("run.ply"));
  ASSERT_GT(mesh.vertices.size(), 1000U);
  EXPECT_GT(mesh.triangles.size(), mesh.vertices.size()) << "vertices are shared";
}

TEST_F(OutputTest, MeshNamedObj_IsTheSameSurfaceAsWavefrontObj) {
  for (const char* name : {"run.ply", "run.obj"}) {
    const Outcome outcome =
        RunTrack({"--sensor", "sim:bottle?frames=10", "--mesh", Path(name)}, scratch());
    ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  }
  const apps::Surface ply = apps::LoadPly(Path("run.ply"));
  const apps::Surface obj = apps::LoadModel(Path("run.obj"));
  ASSERT_EQ(obj.triangles.size(), ply.triangles.size());
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t of_obj = obj.triangles[t][i];
      const std::uint32_t of_ply = ply.triangles[t][i];
      ASSERT_LT((obj.vertices[of_obj] - ply.vertices[of_ply]).norm(), 1e-7);
      ASSERT_GT(obj.normals[of_obj].dot(ply.normals[of_ply]), 0.9999);
    }
  }
}

TEST_F(OutputTest, MeshResolution_DecidesHowManyTrianglesThereAre) {
  std::vector<std::size_t> triangles;
  for (const char* resolution_m : {"0.005", "0.0025", "0.00125"}) {
    const Outcome outcome = RunTrack({"--sensor", "sim:bottle?frames=10", "--mesh", Path("run.ply"),
                                      "--mesh-resolution", resolution_m},
                                     scratch());
    ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
    triangles.push_back(apps::LoadPly(Path("run.ply")).triangles.size());
  }
  EXPECT_GT(triangles[1], 3 * triangles[0]);
  EXPECT_GT(triangles[2], 3 * triangles[1]);
}

TEST_F(OutputTest, MeshPicture_ShowsTheObjectOnWhite) {
  const Outcome outcome =
      RunTrack({"--sensor", "sim:bottle?frames=10", "--mesh-picture", Path("run.png")}, scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  const std::string png = ReadFile(Path("run.png"));
  EXPECT_EQ(png.rfind("\x89PNG", 0), 0U);
  EXPECT_GT(png.size(), 20000U) << "not blank";
}

TEST_F(OutputTest, Flow_IsOneFilePerFrameInAFolderOfItsOwn) {
  const Outcome outcome =
      RunTrack({"--sensor", "sim:bottle?motion=fast&frames=10", "--flow", Path("flow")}, scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  for (int frame = 0; frame < 10; ++frame) {
    const apps::Surface points = apps::LoadPly(Path("flow/00000" + std::to_string(frame) + ".ply"));
    ASSERT_GT(points.vertices.size(), 300U);
    // Camera frame: the object is in front, and what is seen faces the camera.
    for (std::size_t i = 0; i < points.vertices.size(); ++i) {
      ASSERT_GT(points.vertices[i].z(), 0.2);
      ASSERT_LT(points.normals[i].dot(points.vertices[i]), 0.0);
    }
  }
  const Outcome again =
      RunTrack({"--sensor", "sim:bottle?frames=10", "--flow", Path("flow")}, scratch());
  EXPECT_EQ(again.exit_status, 4);
  EXPECT_NE(again.err.find("not empty"), std::string::npos) << again.err;
}

}  // namespace
}  // namespace disflow::test
