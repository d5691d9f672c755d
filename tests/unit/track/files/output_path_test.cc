// SPDX-License-Identifier: BSD-3-Clause
#include "output_path.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "scratch_folder.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

class OutputPathTest : public test::ScratchFolderTest {};

TEST_F(OutputPathTest, NamesOfDescriptors_AreFoundHoweverTheyAreWritten) {
  EXPECT_EQ(DescriptorOf("/proc/self/fd/2"), 2);
  EXPECT_EQ(DescriptorOf("/proc/self/../self/fd/1"), 1);
  EXPECT_EQ(DescriptorOf("/dev/fd/17"), 17);
  EXPECT_EQ(DescriptorOf("/dev/stdout"), 1);
  EXPECT_EQ(DescriptorOf("/dev/stderr"), 2);
  fs::create_symlink("/dev/stdout", Path("log"));
  fs::create_symlink("log", Path("latest"));
  EXPECT_EQ(DescriptorOf(Path("latest")), 1);
}

TEST_F(OutputPathTest, OtherPaths_AreNoDescriptors) {
  test::WriteFile(Path("1"), "");
  fs::create_symlink("circle", Path("circle"));
  for (const std::string& path : {Path("1"), Path("none"), Path("circle"), std::string("/dev/null"),
                                  std::string("/proc/self/fd/x"), std::string("/proc/self/fd/1x"),
                                  std::string("/proc/self/fd/-1"), std::string("/proc/self/fd"),
                                  std::string("1"), std::string()}) {
    EXPECT_EQ(DescriptorOf(path), std::nullopt) << path;
  }
}

TEST_F(OutputPathTest, Links_AreFollowedToAFileThatNeedNotExist) {
  fs::create_directory(Path("results"));
  fs::create_symlink("results/new.ply", Path("a"));
  fs::create_symlink(Path("a"), Path("b"));
  EXPECT_EQ(FollowLinks(Path("b")), fs::path(Path("results/new.ply")));
  EXPECT_EQ(FollowLinks(Path("results/new.ply")), fs::path(Path("results/new.ply")));
  EXPECT_EQ(FollowLinks("plain.ply"), fs::path("plain.ply"));
}

TEST_F(OutputPathTest, LinksInCircles_AreThePathItself) {
  fs::create_symlink("b", Path("a"));
  fs::create_symlink("a", Path("b"));
  EXPECT_EQ(FollowLinks(Path("a")), fs::path(Path("a")));
}

}  // namespace
}  // namespace disflow::apps
