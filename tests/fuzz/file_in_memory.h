// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <string>

namespace disflow::fuzz {

/// A file whose content is the fuzzer's, and a path under which a reader can open it.
class FileInMemory {
 public:
  FileInMemory() : fd_(::memfd_create("fuzz", 0)) {
    if (fd_ < 0) std::abort();
    path_ = "/proc/self/fd/" + std::to_string(fd_);
  }
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;
  ~FileInMemory() { ::close(fd_); }

  void Fill(const std::uint8_t* data, std::size_t size) {
    if (::ftruncate(fd_, 0) != 0) std::abort();
    if (::pwrite(fd_, data, size, 0) != static_cast<ssize_t>(size)) std::abort();
  }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  int fd_;
  std::string path_;
};

/// A folder in which that file has a name, for readers that look at names. Gone when the fuzzer
/// ends.
class FolderWithFile {
 public:
  /// @param names Under which the file is there; may be in folders of their own.
  FolderWithFile(const FileInMemory& file, std::initializer_list<std::filesystem::path> names) {
    std::string folder = "/tmp/disflow_fuzz_XXXXXX";
    if (::mkdtemp(folder.data()) == nullptr) std::abort();
    path_ = folder;
    file_ = path_ / *names.begin();
    for (const std::filesystem::path& name : names) {
      std::filesystem::create_directories((path_ / name).parent_path());
      std::filesystem::create_symlink(file.path(), path_ / name);
    }
  }
  FolderWithFile(const FolderWithFile&) = delete;
  FolderWithFile& operator=(const FolderWithFile&) = delete;
  ~FolderWithFile() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path path_;
  std::filesystem::path file_;
};

inline void Require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace disflow::fuzz
