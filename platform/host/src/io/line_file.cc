// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/line_file.h"

#include <unistd.h>

#include <string>
#include <utility>

#include "disflow/host/file_output.h"

namespace disflow::host {

hal::Fault LineFile::Open(const std::filesystem::path& path) {
  hal::Fault fault = Close();
  if (!fault.ok()) return fault;
  path_ = path;
  whole_bytes_ = 0;
  fd_ = CreateFile(path);
  return is_open() ? hal::Fault{} : WriteFault(path);
}

hal::Fault LineFile::Append(std::string_view line) {
  std::string bytes(line);
  bytes += '\n';
  if (WriteAll(fd_, bytes)) {
    whole_bytes_ += static_cast<std::int64_t>(bytes.size());
    return {};
  }
  const hal::Fault fault = WriteFault(path_);
  // If this fails too, the file ends within a line, as after a kill: readers know of that.
  (void)(::ftruncate(fd_, whole_bytes_) == 0 && ::lseek(fd_, whole_bytes_, SEEK_SET) >= 0);
  return fault;
}

hal::Fault LineFile::Close() {
  if (!is_open()) return {};
  return ::close(std::exchange(fd_, -1)) == 0 ? hal::Fault{} : WriteFault(path_);
}

}  // namespace disflow::host
