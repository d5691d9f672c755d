// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/regular_file.h"

#include <system_error>

namespace disflow::host {

namespace fs = std::filesystem;

hal::Fault CheckRegularFile(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status) || fs::is_regular_file(status)) return {};
  return hal::MakeFault(Status::kCorrupt, "%s: is %s; a regular file is needed", file.c_str(),
                        fs::is_directory(status) ? "a folder" : "a pipe, a socket or a device");
}

}  // namespace disflow::host
