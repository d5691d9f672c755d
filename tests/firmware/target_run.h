// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "answer_csv.h"
#include "board_connection.h"
#include "credited_line.h"
#include "disflow/posix/monotonic_clock.h"
#include "emulator.h"
#include "sequence.h"

namespace disflow::firmware_test {

inline constexpr std::int64_t kPatience_ns = 60'000'000'000;

/// A board that is told frames over its UART.
class FedBoard {
 public:
  explicit FedBoard(const EmulatorOptions& options)
      : emulator_(options), line_(emulator_.uart()), connection_(line_, clock_) {}

  [[nodiscard]] apps::BoardConnection& connection() { return connection_; }
  [[nodiscard]] CreditedLine& line() { return line_; }
  /// @throws std::runtime_error if the board does not answer.
  apps::BoardAnswer Track(const Frame& frame) {
    apps::BoardAnswer answer;
    Check(connection_.Track(frame.View(), kPatience_ns, answer));
    return answer;
  }
  apps::BoardAnswer TrackPackets(const std::vector<std::vector<std::byte>>& packets) {
    apps::BoardAnswer answer;
    Check(connection_.TrackPackets(packets, kPatience_ns, answer));
    return answer;
  }
  void WaitUntilReady() { Check(connection_.WaitUntilReady(kPatience_ns)); }
  static void Check(const hal::Fault& fault) {
    if (!fault.ok()) throw std::runtime_error(fault.message);
  }

 private:
  posix::MonotonicClock clock_;
  Emulator emulator_;
  CreditedLine line_;
  apps::BoardConnection connection_;
};

/// The packets of a sequence, as one run of bytes.
inline std::vector<std::byte> Recording(const std::vector<Frame>& frames, std::size_t count) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i < count; ++i) {
    for (const auto& packet :
         apps::BoardConnection::Packets(frames.at(i).View(), static_cast<std::uint32_t>(i + 1))) {
      bytes.insert(bytes.end(), packet.begin(), packet.end());
    }
  }
  return bytes;
}

/// What the firmware's tracker makes of a sequence when it is built for the host.
inline std::vector<PoseCameraFromObject> TrackOnHost(
    const std::vector<Frame>& frames, const std::string& program = DISFLOW_HOST_REFERENCE) {
  const std::filesystem::path packets = std::filesystem::temp_directory_path() /
                                        ("disflow-packets-" + std::to_string(::getpid()) + ".bin");
  const std::vector<std::byte> bytes = Recording(frames, frames.size());
  std::ofstream(packets, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  const std::string command = program + " < " + packets.string();
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  std::vector<PoseCameraFromObject> poses;
  std::array<float, 7> v{};
  while (pipe != nullptr && std::fscanf(pipe, "%f %f %f %f %f %f %f", &v[0], &v[1], &v[2], &v[3],
                                        &v[4], &v[5], &v[6]) == 7) {
    poses.push_back(
        {PoseCameraFromObject::Quaternion(v[3], v[4], v[5], v[6]), Vec3(v[0], v[1], v[2])});
  }
  if (pipe == nullptr || ::pclose(pipe) != 0 || poses.size() != frames.size()) {
    throw std::runtime_error(command + " failed");
  }
  std::filesystem::remove(packets);
  return poses;
}

/// Puts the first frames of a sequence into the board's memory and collects the answers.
inline std::vector<apps::BoardAnswer> RunRecorded(EmulatorOptions options,
                                                  const std::vector<Frame>& frames,
                                                  std::size_t count) {
  options.recording = Recording(frames, count);
  FedBoard board(options);
  std::vector<apps::BoardAnswer> answers(count);
  for (std::size_t i = 0; i < count; ++i) {
    FedBoard::Check(board.connection().AwaitRecorded(static_cast<std::uint32_t>(i + 1),
                                                     kPatience_ns, answers[i]));
  }
  return answers;
}

}  // namespace disflow::firmware_test
