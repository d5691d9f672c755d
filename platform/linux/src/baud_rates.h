// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <termios.h>

#include <array>
#include <cstdint>

namespace disflow::posix {

struct BaudRate {
  std::uint32_t bits_per_s;
  speed_t constant;
};

/// The rates that POSIX and Linux name.
inline constexpr std::array kBaudRates{
    BaudRate{1200, B1200},       BaudRate{2400, B2400},       BaudRate{4800, B4800},
    BaudRate{9600, B9600},       BaudRate{19200, B19200},     BaudRate{38400, B38400},
    BaudRate{57600, B57600},     BaudRate{115200, B115200},   BaudRate{230400, B230400},
    BaudRate{460800, B460800},   BaudRate{500000, B500000},   BaudRate{576000, B576000},
    BaudRate{921600, B921600},   BaudRate{1000000, B1000000}, BaudRate{1152000, B1152000},
    BaudRate{1500000, B1500000}, BaudRate{2000000, B2000000}, BaudRate{2500000, B2500000},
    BaudRate{3000000, B3000000}, BaudRate{3500000, B3500000}, BaudRate{4000000, B4000000},
};

}  // namespace disflow::posix
