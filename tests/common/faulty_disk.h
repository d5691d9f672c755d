// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

/// @file
/// A disk that is full after so many bytes or calls, or a program that is killed there. A program
/// that links disflow_faulty_disk has its libraries' calls that change files led here.

namespace disflow::test {

/// What happens when there is no more room.
enum class DiskEnd : std::uint8_t {
  kFull,          ///< What has room is written, then no more; files are made and closed still.
  kFullForAll,    ///< Then nothing is made either, and closing says what it says of a full disk.
  kKilled,        ///< Killed with what has room written, in the middle of a write or at its begin.
  kKilledBefore,  ///< Killed as soon as so many bytes are written, before anything else is done.
};

struct FaultyDisk {
  static constexpr std::int64_t kEndless = std::numeric_limits<std::int64_t>::max();

  std::int64_t room_bytes = kEndless;
  std::int64_t room_calls = kEndless;  ///< That make a file or folder, or close one; kills come
                                       ///< before the next.
  DiskEnd end = DiskEnd::kFull;
  bool can_cut = true;    ///< Files can be shortened when it is full.
  bool can_close = true;  ///< Or what was taken before turns out not to fit when a file is closed.
  std::int64_t written_bytes = 0;
  std::int64_t calls = 0;
  std::vector<std::size_t> writes;  ///< Their sizes.
};

/// Where the program writes.
inline FaultyDisk disk;

}  // namespace disflow::test
