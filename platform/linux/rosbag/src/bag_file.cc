// SPDX-License-Identifier: BSD-3-Clause
#include "bag_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace disflow::posix {

using hal::Fault;
using hal::MakeFault;

Fault BagFile::Open(const std::filesystem::path& path) {
  path_ = path;
  descriptor_ = FileDescriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (!descriptor_.is_open() || ::fstat(descriptor_.get(), &status) != 0)
    return MakeFault(Status::kIoError, "%s: %s", path.c_str(), std::strerror(errno));
  size_ = static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0));
  return {};
}

Fault BagFile::Read(std::uint64_t begin, std::span<std::uint8_t> bytes) const {
  while (!bytes.empty()) {
    const ssize_t count = RetryOnSignal([&] {
      return ::pread(descriptor_.get(), bytes.data(), bytes.size(), static_cast<off_t>(begin));
    });
    if (count <= 0) {
      return MakeFault(Status::kIoError, "%s: byte %ju: %s", path_.c_str(), std::uintmax_t{begin},
                       count < 0 ? std::strerror(errno) : "the file has become shorter");
    }
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    begin += static_cast<std::uint64_t>(count);
  }
  return {};
}

Fault BagFile::Corrupt(std::uint64_t begin, const char* problem) const {
  return MakeFault(Status::kCorrupt, "%s: byte %ju: %s", path_.c_str(), std::uintmax_t{begin},
                   problem);
}

Fault BagFile::IsOver() const {
  return MakeFault(Status::kEndOfStream, "%s: is over", path_.c_str());
}

std::string BagFile::CutShort() const {
  return path_.string() + ": the recording was cut short; it is played as far as it is whole";
}

}  // namespace disflow::posix
