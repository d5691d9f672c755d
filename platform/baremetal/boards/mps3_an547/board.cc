// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Arm MPS3 with the AN547 image: Cortex-M55 at 32 MHz; qemu-system-arm -M mps3-an547. Depth images
/// come over UART 0, or from a recording in the DDR memory if there is one; telemetry goes out over
/// UART 0. All addresses are the secure ones.

#include "disflow/baremetal/board.h"

#include <array>

#include "../../src/cmsdk_uart.h"
#include "../../src/recorded_line.h"
#include "disflow/baremetal/startup.h"
#include "disflow/baremetal/stream_memory.h"
#include "disflow/baremetal/tick_clock.h"
#include "disflow/hal/depth_stream/stream_sensor.h"

namespace disflow::baremetal {
namespace {

constexpr std::uint32_t kClockHz = 32'000'000;
constexpr std::uintptr_t kUart0 = 0x59303000;
constexpr std::uint32_t kBaud = 921'600;
constexpr std::uintptr_t kSystemCounterControl = 0x58100000;
constexpr std::uintptr_t kSystemCounter = 0x58101000;
constexpr std::uintptr_t kDdr = 0x70000000;

std::uint32_t ReadTicks() noexcept { return Register(kSystemCounter); }

TickClock<ReadTicks, kClockHz> board_clock;
CmsdkUart uart(kUart0, kClockHz, kBaud);
RecordedLine recording(kDdr, uart);
hal::depth_stream::StreamSensor depth_source(recording.given()
                                                 ? static_cast<hal::ByteLink&>(recording)
                                                 : uart,
                                             board_clock, StreamImage(), Budgets());

void OnUartReceive() { uart.OnReceive(); }
void OnUartTransmit() { uart.OnTransmit(); }

constexpr unsigned kUart0Receive = 33;
DISFLOW_BOARD_VECTORS constexpr auto kBoardVectors = [] {
  std::array<Vector, kUart0Receive + 2> vectors{};
  vectors[kUart0Receive] = OnUartReceive;
  vectors[kUart0Receive + 1] = OnUartTransmit;
  return vectors;
}();

}  // namespace

void StartBoard() noexcept {
  Register(kSystemCounterControl) = 1;
  EnableInterrupt(kUart0Receive);
  EnableInterrupt(kUart0Receive + 1);
}

hal::ByteLink& BoardUart() noexcept { return uart; }
hal::Clock& BoardClock() noexcept { return board_clock; }
hal::DepthSensor& BoardDepthSource() noexcept { return depth_source; }

}  // namespace disflow::baremetal
