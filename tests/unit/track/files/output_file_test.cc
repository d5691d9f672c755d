// SPDX-License-Identifier: BSD-3-Clause
#include "files/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <thread>

#include "program/exit_status.h"
#include "resource_limit.h"
#include "scratch_folder.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public test::ScratchFolderTest {
 protected:
  /// @return How many files the folder holds.
  [[nodiscard]] std::ptrdiff_t Files() const {
    return std::distance(fs::directory_iterator(scratch()), fs::directory_iterator());
  }
};

TEST_F(OutputFileTest, AtomicFile_ChangesNothingBeforeItIsCommitted) {
  test::WriteFile(Path("mesh"), "earlier");
  AtomicFile file(Path("mesh"));
  EXPECT_EQ(test::ReadFile(Path("mesh")), "earlier");
  file.Commit("new");
  EXPECT_EQ(test::ReadFile(Path("mesh")), "new");
  EXPECT_EQ(Files(), 1);
}

TEST_F(OutputFileTest, AtomicFileNotCommitted_LeavesNothingBehind) {
  { const AtomicFile file(Path("mesh")); }
  EXPECT_EQ(Files(), 0);
  test::WriteFile(Path("mesh"), "earlier");
  { const AtomicFile file(Path("mesh")); }
  EXPECT_EQ(test::ReadFile(Path("mesh")), "earlier");
  EXPECT_EQ(Files(), 1);
}

TEST_F(OutputFileTest, AtomicFile_HasNoPartOnDiskBeforeItIsCommitted) {
  AtomicFile file(Path("mesh"));
  EXPECT_EQ(Files(), 0) << "a kill would leave it behind";
  file.Commit("new");
  EXPECT_EQ(test::ReadFile(Path("mesh")), "new");
}

TEST_F(OutputFileTest, Link_StaysAndLeadsToWhatWasCommitted) {
  test::WriteFile(Path("real"), "earlier");
  fs::create_symlink("real", Path("link"));
  AtomicFile file(Path("link"));
  EXPECT_EQ(test::ReadFile(Path("real")), "earlier");
  file.Commit("new");
  EXPECT_TRUE(fs::is_symlink(Path("link")));
  EXPECT_EQ(test::ReadFile(Path("real")), "new");
  EXPECT_EQ(Files(), 2);
}

TEST_F(OutputFileTest, FileThatTheProgramWasStartedWith_GoesOnAndKeepsWhatIsInIt) {
  test::WriteFile(Path("log"), "earlier\n");
  const posix::FileDescriptor log(::open(Path("log").c_str(), O_WRONLY | O_APPEND));
  ASSERT_TRUE(log.is_open());
  const std::string name = "/proc/self/fd/" + std::to_string(log.get());
  RecordFile records(name);
  ASSERT_TRUE(records.Append("record\n"));
  AtomicFile(name).Commit("mesh\n");
  ASSERT_TRUE(records.Append("record\n"));
  EXPECT_EQ(test::ReadFile(Path("log")), "earlier\nrecord\nmesh\nrecord\n");
  EXPECT_EQ(Files(), 1);
}

TEST_F(OutputFileTest, PartThatAKilledRunLeft_IsTakenOver) {
  test::WriteFile(Path("mesh.part"), "much longer than what comes");
  AtomicFile(Path("mesh")).Commit("new");
  EXPECT_EQ(test::ReadFile(Path("mesh")), "new");
  EXPECT_EQ(Files(), 1);

  test::WriteFile(Path("mesh.part"), "left again");
  { const AtomicFile file(Path("mesh")); }
  EXPECT_EQ(Files(), 1) << "though nothing is written this time";
}

TEST_F(OutputFileTest, AtomicFileThatFindsNoRoom_LeavesTheEarlierOneAndNoPart) {
  (void)::signal(SIGXFSZ, SIG_IGN);  // as the program does
  test::WriteFile(Path("mesh"), "earlier");
  AtomicFile file(Path("mesh"));
  {
    const test::ResourceLimit limit(RLIMIT_FSIZE, 1000);
    EXPECT_THROW(file.Commit(std::string(2000, 'x')), Failure);
  }
  EXPECT_EQ(test::ReadFile(Path("mesh")), "earlier");
  EXPECT_EQ(Files(), 1);
}

TEST_F(OutputFileTest, AtomicFileWhoseFolderVanishes_FailsAtItsCommit) {
  fs::create_directory(Path("folder"));
  AtomicFile file(Path("folder/mesh"));
  fs::remove_all(Path("folder"));
  try {
    file.Commit("new");
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.status(), kOutputFailed);
    EXPECT_NE(std::string(failure.what()).find("folder/mesh: cannot be written"), std::string::npos)
        << failure.what();
  }
}

TEST_F(OutputFileTest, PathThatCannotBeAFile_IsRefusedBeforeTheRun) {
  EXPECT_THROW(AtomicFile(scratch().string()), Failure);
  EXPECT_THROW(RecordFile(scratch().string()), Failure);
  EXPECT_THROW(AtomicFile(Path("nowhere/mesh")), Failure);
  EXPECT_THROW(RecordFile(Path("nowhere/csv")), Failure);
  EXPECT_EQ(Files(), 0);
}

TEST_F(OutputFileTest, RecordFile_EmptiesWhatWasThere) {
  test::WriteFile(Path("csv"), "earlier and longer\n");
  RecordFile file(Path("csv"));
  EXPECT_TRUE(file.Append("a\n"));
  EXPECT_TRUE(file.Append("b\n"));
  EXPECT_EQ(test::ReadFile(Path("csv")), "a\nb\n");
}

TEST_F(OutputFileTest, DeviceThatIsFull_FailsOnceAndStaysFailed) {
  RecordFile file("/dev/full");
  EXPECT_FALSE(file.Append("a\n"));
  EXPECT_EQ(file.error(), ENOSPC);
  EXPECT_FALSE(file.Append("b\n"));
  EXPECT_THROW(AtomicFile("/dev/full").Commit("mesh"), Failure);
}

TEST_F(OutputFileTest, PipeThatIsRead_GetsEverythingHoweverSlowItsReader) {
  ASSERT_EQ(::mkfifo(Path("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([this, &received] { received = test::ReadFile(Path("pipe")); });
  // Much more than a pipe holds.
  const std::string sent(1'000'000, 'x');
  {
    RecordFile file(Path("pipe"));
    EXPECT_TRUE(file.Append(sent));
  }
  reader.join();
  EXPECT_EQ(received, sent);
  EXPECT_TRUE(fs::is_fifo(Path("pipe")));
}

TEST_F(OutputFileTest, AtomicFileOnAPipe_IsWrittenIntoIt) {
  ASSERT_EQ(::mkfifo(Path("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([this, &received] { received = test::ReadFile(Path("pipe")); });
  const std::string sent(300'000, 'x');
  {
    AtomicFile file(Path("pipe"));
    file.Commit(sent);
  }
  reader.join();
  EXPECT_EQ(received, sent);
  EXPECT_EQ(Files(), 1);
}

TEST_F(OutputFileTest, ReaderThatGoesAway_IsAnErrorOfTheOutput) {
  (void)::signal(SIGPIPE, SIG_IGN);  // as the program does
  ASSERT_EQ(::mkfifo(Path("pipe").c_str(), 0600), 0);
  const int reader = ::open(Path("pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  RecordFile file(Path("pipe"));
  EXPECT_TRUE(file.Append("a\n"));
  ::close(reader);
  EXPECT_FALSE(file.Append("b\n"));
  EXPECT_EQ(file.error(), EPIPE);
}

}  // namespace
}  // namespace disflow::apps
