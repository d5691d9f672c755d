// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "disflow/posix/socket_link.h"

namespace disflow::firmware_test {

/// A board that qemu emulates.
struct Board {
  const char* name;
  const char* machine;
  const char* image;
  const char* recording_address;  ///< Where its firmware looks for a recording.

  friend void PrintTo(const Board& board, std::ostream* stream) { *stream << board.name; }
};
inline constexpr Board kM7{"Cortex-M7", "mps2-an500",
                           DISFLOW_FIRMWARE_BUILDS "/cortex-m7/bin/disflow_firmware_mps2_an500.elf",
                           "0x60000000"};
inline constexpr Board kM55{
    "Cortex-M55", "mps3-an547",
    DISFLOW_FIRMWARE_BUILDS "/cortex-m55/bin/disflow_firmware_mps3_an547.elf", "0x70000000"};

struct EmulatorOptions {
  Board board = kM7;
  std::string image{};                 ///< In place of the board's firmware.
  int icount_shift = -1;               ///< An instruction takes 2^shift ns; -1: real time.
  std::vector<std::byte> recording{};  ///< Packets to put into the board's memory.
};

/// A running emulator, its UART on a socket. Ends with the object.
class Emulator {
 public:
  explicit Emulator(const EmulatorOptions& options);
  ~Emulator();
  Emulator(const Emulator&) = delete;
  Emulator& operator=(const Emulator&) = delete;

  /// Connected to the board's UART. @throws std::runtime_error if it cannot be.
  [[nodiscard]] hal::ByteLink& uart() { return *uart_; }
  /// @return Why firmware cannot be emulated here, empty if it can.
  [[nodiscard]] static std::string Missing(const Board& board);

 private:
  std::filesystem::path folder_;
  pid_t process_ = -1;
  std::unique_ptr<posix::SocketLink> uart_;
};

}  // namespace disflow::firmware_test
