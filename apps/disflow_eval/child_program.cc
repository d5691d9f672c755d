// SPDX-License-Identifier: BSD-3-Clause
#include "child_program.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "errors.h"

namespace disflow::apps {

int RunProgram(std::vector<std::string> words, const std::filesystem::path& folder) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw OutputError(folder, std::string("fork failed: ") + std::strerror(errno));
  if (child == 0) {
    if (::chdir(folder.c_str()) != 0) ::_exit(EXIT_FAILURE);
    ::execvp(arguments[0], arguments.data());
    ::_exit(kProgramNotFound);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw OutputError(folder, "lost track of " + words[0]);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILURE;
}

}  // namespace disflow::apps
