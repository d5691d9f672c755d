// SPDX-License-Identifier: BSD-3-Clause
// File systems that say only when a file is closed that they could not keep what they took, as NFS
// does of a full disk.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <thread>

#include "faulty_disk.h"
#include "files/output_file.h"
#include "program/exit_status.h"
#include "scratch_folder.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

class DiskThatSaysSoWhenFilesAreClosed : public test::ScratchFolderTest {
 protected:
  ~DiskThatSaysSoWhenFilesAreClosed() override { test::disk = {}; }

  template <class Write>
  void ExpectSaysFull(const std::string& path, Write&& write) const {
    try {
      test::disk.can_close = false;
      write();
      ADD_FAILURE() << "nothing was said";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.status(), kOutputFailed);
      EXPECT_EQ(failure.what(), path + ": cannot be written: No space left on device");
    }
    test::disk = {};
  }
  /// @return How many files the folder holds.
  [[nodiscard]] std::ptrdiff_t Files() const {
    return std::distance(fs::directory_iterator(scratch()), fs::directory_iterator());
  }
};

TEST_F(DiskThatSaysSoWhenFilesAreClosed, AtomicFile_FailsAndLeavesTheEarlierOneAndNoPart) {
  test::WriteFile(Path("mesh"), "earlier");
  AtomicFile file(Path("mesh"));
  ExpectSaysFull(Path("mesh"), [&file] { file.Commit("new"); });
  EXPECT_EQ(test::ReadFile(Path("mesh")), "earlier");
  EXPECT_EQ(Files(), 1);
}

TEST_F(DiskThatSaysSoWhenFilesAreClosed, ReplacedFile_FailsAndLeavesNothingBehind) {
  ExpectSaysFull(Path("flow.ply"), [this] { ReplaceFile(Path("flow.ply"), "new"); });
  EXPECT_EQ(Files(), 0);
}

TEST_F(DiskThatSaysSoWhenFilesAreClosed, AtomicFileOnAPipeOrDevice_Fails) {
  ASSERT_EQ(::mkfifo(Path("pipe").c_str(), 0600), 0);
  std::thread reader([this] { (void)test::ReadFile(Path("pipe")); });
  AtomicFile file(Path("pipe"));
  ExpectSaysFull(Path("pipe"), [&file] { file.Commit("mesh"); });
  reader.join();
}

}  // namespace
}  // namespace disflow::apps
