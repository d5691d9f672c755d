// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "answer_csv.h"
#include "board_connection.h"
#include "disflow/posix/monotonic_clock.h"
#include "emulator.h"
#include "sequence.h"

namespace disflow::firmware_test {

inline constexpr std::int64_t kPatience_ns = 60'000'000'000;

/// A board that is told frames over its UART.
class FedBoard {
 public:
  explicit FedBoard(const EmulatorOptions& options)
      : emulator_(options), connection_(emulator_.uart(), clock_) {}

  [[nodiscard]] apps::BoardConnection& connection() { return connection_; }
  [[nodiscard]] hal::ByteLink& uart() { return emulator_.uart(); }
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
