// SPDX-License-Identifier: BSD-3-Clause
#include "limited_process.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <exception>
#include <fstream>
#include <stdexcept>

namespace disflow::test {
namespace {

constexpr rlim_t kMemory_bytes = rlim_t{256} << 20U;

void Limit(int resource, rlim_t value) {
  const rlimit limit{.rlim_cur = value, .rlim_max = value};
  if (::setrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0) ::_exit(1);
}

rlim_t UsedMemory_bytes() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

[[noreturn]] void RunChild(const std::function<std::string()>& function, unsigned most_s, int out) {
  Limit(RLIMIT_CORE, 0);
  Limit(RLIMIT_CPU, most_s);
  Limit(RLIMIT_AS, UsedMemory_bytes() + kMemory_bytes);
  std::string message;
  try {
    message = function();
  } catch (const std::exception& error) {
    message = std::string("not refused but thrown: ") + error.what();
  }
  (void)!::write(out, message.data(), message.size());
  ::_exit(0);
}

}  // namespace

LimitedOutcome RunLimited(const std::function<std::string()>& function, unsigned most_s) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) RunChild(function, most_s, pipe[1]);
  ::close(pipe[1]);
  LimitedOutcome outcome;
  std::array<char, 4096> part{};
  for (ssize_t bytes = 0; (bytes = ::read(pipe[0], part.data(), part.size())) != 0;) {
    if (bytes > 0) outcome.message.append(part.data(), static_cast<std::size_t>(bytes));
    if (bytes < 0 && errno != EINTR) break;
  }
  ::close(pipe[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return outcome;
}

}  // namespace disflow::test
