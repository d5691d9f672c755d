// SPDX-License-Identifier: BSD-3-Clause
#include "errno_fault.h"

#include <cstring>

namespace disflow::posix {

hal::Fault ErrnoFault(Status status, const char* name, const char* what, int error) noexcept {
  char buffer[128] = {};
  // The GNU variant, which glibc declares for C++: the text need not be in `buffer`.
  const char* const words = ::strerror_r(error, buffer, sizeof(buffer));
  return hal::MakeFault(status, "%s: %s: %s", name, what, words);
}

}  // namespace disflow::posix
