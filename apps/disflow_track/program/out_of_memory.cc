// SPDX-License-Identifier: BSD-3-Clause
#include "program/out_of_memory.h"

#include <unistd.h>

#include <new>
#include <string_view>

#include "program/exit_status.h"

namespace disflow::apps {
namespace {

/// In any thread; must not allocate.
[[noreturn]] void End() {
  constexpr std::string_view kMessage =
      "disflow_track: out of memory; allow it more (ulimit -v, MemoryMax= of the service) or "
      "choose "
      "a smaller --profile\n";
  (void)!::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  ::_exit(kInputFailed);
}

}  // namespace

void EndWhenOutOfMemory() noexcept { (void)std::set_new_handler(End); }

}  // namespace disflow::apps
