// SPDX-License-Identifier: BSD-3-Clause
#include "emulator.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace disflow::firmware_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kQemu = "/usr/bin/qemu-system-arm";
constexpr int kConnectTries = 3000;                    // a minute: the host may be busy
constexpr std::uint32_t kRecordingMagic = 0x43524644;  // RecordedLine::kMagic

void WriteRecording(const fs::path& file, const std::vector<std::byte>& bytes) {
  const std::array<std::uint32_t, 2> header{kRecordingMagic,
                                            static_cast<std::uint32_t>(bytes.size())};
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(header.data()), sizeof(header));
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

pid_t Spawn(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t process = -1;
  if (::posix_spawn(&process, kQemu, nullptr, nullptr, argv.data(), environ) != 0) {
    throw std::runtime_error(std::string(kQemu) + " cannot be started");
  }
  return process;
}

}  // namespace

std::string Emulator::Missing(const Board& board) {
  if (std::getenv("DISFLOW_TEST_FIRMWARE") == nullptr) return "run by ./dev test --firmware";
  if (!fs::exists(kQemu)) return std::string(kQemu) + " is missing";
  if (!fs::exists(board.image)) return std::string(board.image) + " is not built";
  return {};
}

Emulator::Emulator(const EmulatorOptions& options) {
  std::string pattern = fs::temp_directory_path() / "disflow-firmware-XXXXXX";
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = pattern;
  const std::string socket = folder_ / "uart";
  std::vector<std::string> arguments{kQemu,
                                     "-M",
                                     options.board.machine,
                                     "-display",
                                     "none",
                                     "-monitor",
                                     "none",
                                     "-serial",
                                     "unix:" + socket + ",server=on,wait=on",
                                     "-semihosting-config",
                                     "enable=on,target=native",
                                     "-kernel",
                                     options.image.empty() ? options.board.image : options.image};
  if (options.icount_shift >= 0) {
    arguments.insert(arguments.end(),
                     {"-icount", "shift=" + std::to_string(options.icount_shift) + ",sleep=off"});
  }
  if (!options.recording.empty()) {
    const fs::path file = folder_ / "recording";
    WriteRecording(file, options.recording);
    arguments.insert(arguments.end(), {"-device", "loader,force-raw=on,file=" + file.string() +
                                                      ",addr=" + options.board.recording_address});
  }
  process_ = Spawn(arguments);
  uart_ = std::make_unique<posix::SocketLink>("unix:" + socket);
  for (int i = 0; i < kConnectTries && !uart_->Open().ok(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const hal::Fault fault = uart_->Open();
  if (!fault.ok()) throw std::runtime_error(fault.message);
}

Emulator::~Emulator() {
  if (process_ > 0) {
    (void)::kill(process_, SIGKILL);
    (void)::waitpid(process_, nullptr, 0);
  }
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace disflow::firmware_test
