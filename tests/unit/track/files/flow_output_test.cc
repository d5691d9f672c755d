// SPDX-License-Identifier: BSD-3-Clause
#include "files/flow_output.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "refusal.h"
#include "scratch_folder.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

using FlowOutputTest = test::ScratchFolderTest;

TEST_F(FlowOutputTest, PartOfAFrameThatAKilledRunLeft_IsRemovedAndTheFolderIsUsed) {
  fs::create_directory(Path("flow"));
  test::WriteFile(Path("flow/000000.ply.part"), "ply\n");
  FlowOutput flow(Path("flow"));
  EXPECT_TRUE(fs::is_empty(Path("flow")));
  flow.Write(0, {});
  EXPECT_TRUE(fs::exists(Path("flow/000000.ply")));
}

TEST_F(FlowOutputTest, WholeFrames_AreKeptAndTheFolderIsRefused) {
  fs::create_directory(Path("flow"));
  test::WriteFile(Path("flow/000000.ply"), "ply\n");
  test::WriteFile(Path("flow/000001.ply.part"), "ply\n");
  const std::string refusal = RefusalOf([&] { FlowOutput flow(Path("flow")); }, kOutputFailed);
  EXPECT_EQ(refusal.find(Path("flow") + ": is not empty; give another folder"), 0U) << refusal;
  EXPECT_EQ(test::ReadFile(Path("flow/000000.ply")), "ply\n");
  EXPECT_FALSE(fs::exists(Path("flow/000001.ply.part")));
}

TEST_F(FlowOutputTest, PartsOfOtherPrograms_AreNotTouched) {
  for (const char* name : {"video.part", "a000000.ply.part", ".ply.part", "000000.obj.part"}) {
    fs::remove_all(Path("flow"));
    fs::create_directory(Path("flow"));
    test::WriteFile(Path("flow/" + std::string(name)), "mine\n");
    EXPECT_NE(RefusalOf([&] { FlowOutput flow(Path("flow")); }, kOutputFailed), "") << name;
    EXPECT_EQ(test::ReadFile(Path("flow/" + std::string(name))), "mine\n");
  }
}

}  // namespace
}  // namespace disflow::apps
