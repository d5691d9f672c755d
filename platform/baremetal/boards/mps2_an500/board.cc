// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Arm MPS2 with the AN500 image: Cortex-M7 at 25 MHz; qemu-system-arm -M mps2-an500. Depth images
/// come over UART 0, or from a recording in the PSRAM if there is one; telemetry goes out over UART
/// 0.

#include "disflow/baremetal/board.h"

#include "../../src/cmsdk_uart.h"
#include "../../src/recorded_line.h"
#include "disflow/baremetal/startup.h"
#include "disflow/baremetal/stream_memory.h"
#include "disflow/baremetal/tick_clock.h"
#include "disflow/hal/depth_stream/stream_sensor.h"

namespace disflow::baremetal {
namespace {

constexpr std::uint32_t kClockHz = 25'000'000;
constexpr std::uintptr_t kUart0 = 0x40004000;
constexpr std::uint32_t kBaud = 921'600;
// Of the timer, by offset from kTimer0 (CMSDK, DDI 0479, section 4.1).
constexpr std::uintptr_t kTimer0 = 0x40000000;
constexpr std::uintptr_t kTimerControl = 0x00;
constexpr std::uintptr_t kTimerValue = 0x04;
constexpr std::uintptr_t kTimerReload = 0x08;
constexpr std::uint32_t kTimerOn = 1;
constexpr std::uint32_t kTimerFull = 0xFFFFFFFF;
constexpr unsigned kUart0Receive = 0;  // interrupt; that of the transmitter comes next
constexpr std::uintptr_t kPsram = 0x60000000;

/// The timer counts down.
std::uint32_t ReadTicks() noexcept { return ~Register(kTimer0 + kTimerValue); }

TickClock<ReadTicks, kClockHz> board_clock;
CmsdkUart uart(kUart0, kClockHz, kBaud);
RecordedLine recording(kPsram, uart);
hal::depth_stream::StreamSensor depth_source(recording.given()
                                                 ? static_cast<hal::ByteLink&>(recording)
                                                 : uart,
                                             board_clock, StreamImage(), Budgets());

void OnUartReceive() { uart.OnReceive(); }
void OnUartTransmit() { uart.OnTransmit(); }

DISFLOW_BOARD_VECTORS const Vector kBoardVectors[] = {OnUartReceive, OnUartTransmit};

}  // namespace

void StartBoard() noexcept {
  Register(kTimer0 + kTimerReload) = kTimerFull;
  Register(kTimer0 + kTimerValue) = kTimerFull;
  Register(kTimer0 + kTimerControl) = kTimerOn;
  EnableInterrupt(kUart0Receive);
  EnableInterrupt(kUart0Receive + 1);
}

hal::ByteLink& BoardUart() noexcept { return uart; }
hal::Clock& BoardClock() noexcept { return board_clock; }
hal::DepthSensor& BoardDepthSource() noexcept { return depth_source; }

}  // namespace disflow::baremetal
