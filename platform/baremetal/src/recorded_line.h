// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "cmsdk_uart.h"

namespace disflow::baremetal {

/// Bytes that a loader put into the board's memory, as if they came over a line; what is sent goes
/// over a real one. An emulator thus tracks hundreds of frames in seconds, and a frame costs the
/// same number of instructions in every run.
class RecordedLine final : public hal::ByteLink {
 public:
  /// @param address Where a recording may lie: kMagic, its size in bytes (32 bits), then the bytes.
  RecordedLine(std::uintptr_t address, CmsdkUart& answers) noexcept
      : header_(reinterpret_cast<const volatile std::uint32_t*>(address)), answers_(answers) {}

  static constexpr std::uint32_t kMagic = 0x43524644;  ///< "DFRC", little endian; also in tests.
  [[nodiscard]] bool given() const noexcept { return header_[0] == kMagic; }

 private:
  hal::Fault DoOpen() noexcept override { return answers_.Open(); }
  void DoClose() noexcept override { answers_.Close(); }
  hal::Fault DoSend(std::span<const std::byte> message) noexcept override {
    return answers_.Send(message);
  }
  Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override {
    // Time spent in the line's interrupts would count as work on the next frame.
    if (!answers_.idle()) return {};
    const auto* const bytes = reinterpret_cast<const volatile std::byte*>(header_ + 2);
    std::size_t size = 0;
    while (size < buffer.size() && next_ < header_[1]) buffer[size++] = bytes[next_++];
    return {size};
  }
  [[nodiscard]] const char* DoName() const noexcept override { return "recording in memory"; }
  [[nodiscard]] hal::LinkCounters DoCounters() const noexcept override {
    return answers_.counters();
  }

  const volatile std::uint32_t* header_;
  CmsdkUart& answers_;
  std::uint32_t next_ = 0;
};

}  // namespace disflow::baremetal
