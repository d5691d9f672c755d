// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "disflow/hal/byte_link.h"
#include "disflow/posix/monotonic_clock.h"

namespace disflow::firmware_test {

/// Sends no faster than a serial line does. An emulated UART takes bytes as fast as its interrupt
/// handler reads them, and on a busy host leaves the program behind it no time.
class PacedLine final : public hal::ByteLink {
 public:
  explicit PacedLine(hal::ByteLink& line) noexcept : line_(line) {}

 private:
  static constexpr std::int64_t kByte_ns = 10'000'000'000 / 921'600;

  hal::Fault DoOpen() noexcept override { return line_.Open(); }
  void DoClose() noexcept override { line_.Close(); }
  hal::Fault DoSend(std::span<const std::byte> message) noexcept override {
    clock_.SleepUntilNs(free_ns_);
    const hal::Fault fault = line_.Send(message);
    if (fault.ok()) {
      free_ns_ =
          std::max(free_ns_, clock_.NowNs()) + static_cast<std::int64_t>(message.size()) * kByte_ns;
    }
    return fault;
  }
  Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override {
    return line_.Receive(buffer);
  }
  [[nodiscard]] const char* DoName() const noexcept override { return line_.name(); }
  [[nodiscard]] hal::LinkCounters DoCounters() const noexcept override { return line_.counters(); }

  hal::ByteLink& line_;
  posix::MonotonicClock clock_;
  std::int64_t free_ns_ = 0;  ///< When the last byte is through.
};

}  // namespace disflow::firmware_test
