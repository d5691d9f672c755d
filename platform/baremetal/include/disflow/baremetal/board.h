// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/hal/byte_link.h"
#include "disflow/hal/clock.h"
#include "disflow/hal/depth_sensor.h"

/// @file
/// All that the firmware wants of a board. A board is one folder in boards/ that defines these
/// functions, its interrupt vectors (startup.h) and its memories (memory.ld): docs/porting.md.

namespace disflow::baremetal {

/// Called once, before main() and after static objects are made: clocks, pins, interrupts.
void StartBoard() noexcept;

/// Where telemetry goes.
[[nodiscard]] hal::ByteLink& BoardUart() noexcept;
[[nodiscard]] hal::Clock& BoardClock() noexcept;
[[nodiscard]] hal::DepthSensor& BoardDepthSource() noexcept;

}  // namespace disflow::baremetal
