// SPDX-License-Identifier: BSD-3-Clause
#include "child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <sstream>
#include <stdexcept>

extern char** environ;

namespace disflow::test {
namespace {

std::string ReadText(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

Arguments CommandLine(const std::string& program, const Arguments& arguments) {
  Arguments command;
  // A CMake list, empty when the tests run on the machine that built them.
  std::istringstream emulator(DISFLOW_EMULATOR);
  for (std::string part; std::getline(emulator, part, ';');) command.push_back(part);
  command.push_back(program);
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

}  // namespace

ChildProcess::ChildProcess(const std::string& program, const Arguments& arguments,
                           const std::filesystem::path& scratch) {
  static std::atomic<int> count = 0;
  const std::string number = std::to_string(count++);
  out_ = scratch / ("stdout" + number);
  err_ = scratch / ("stderr" + number);
  Arguments command = CommandLine(program, arguments);
  std::vector<char*> argv;
  for (std::string& part : command) argv.push_back(part.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out_.c_str(), kFlags, 0666);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err_.c_str(), kFlags, 0666);
  const int error = ::posix_spawnp(&pid_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error(program + " cannot be started");
}

ChildProcess::~ChildProcess() {
  if (pid_ < 0) return;
  Signal(SIGKILL);
  (void)::waitpid(pid_, nullptr, 0);
}

void ChildProcess::Signal(int signal_number) const { (void)::kill(pid_, signal_number); }

std::string ChildProcess::said() const { return ReadText(err_); }

Outcome ChildProcess::Wait() {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  Outcome outcome;
  outcome.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  outcome.out = ReadText(out_);
  outcome.err = ReadText(err_);
  return outcome;
}

Outcome RunTrack(const Arguments& arguments, const std::filesystem::path& scratch) {
  return ChildProcess(DISFLOW_TRACK, arguments, scratch).Wait();
}

Outcome RunSim(const Arguments& arguments, const std::filesystem::path& scratch) {
  return ChildProcess(DISFLOW_SIM, arguments, scratch).Wait();
}

}  // namespace disflow::test
