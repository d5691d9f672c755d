// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/baremetal/byte_ring.h"
#include "disflow/baremetal/registers.h"
#include "disflow/hal/byte_link.h"

namespace disflow::baremetal {

/// The UART of Arm's CMSDK, as on the MPS boards (DDI 0479, section 4.3). Interrupts move its bytes
/// to and from rings, so that nothing is lost while the tracker works and the rings have room.
class CmsdkUart final : public hal::ByteLink {
 public:
  CmsdkUart(std::uintptr_t base, std::uint32_t clock_hz, std::uint32_t baud) noexcept
      : base_(base), divider_(clock_hz / baud < 16 ? 16 : clock_hz / baud) {}

  void OnReceive() noexcept;
  void OnTransmit() noexcept;
  /// Whether all that was given to Send() has left.
  [[nodiscard]] bool idle() const noexcept;

 private:
  static constexpr std::uint32_t kReceiveCapacity = 512;  // 5 ms at 921600 baud
  static constexpr std::uint32_t kSendCapacity = 1024;

  hal::Fault DoOpen() noexcept override;
  void DoClose() noexcept override;
  hal::Fault DoSend(std::span<const std::byte> message) noexcept override;
  Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override;
  [[nodiscard]] const char* DoName() const noexcept override { return "uart"; }
  [[nodiscard]] hal::LinkCounters DoCounters() const noexcept override { return counters_; }

  [[nodiscard]] volatile std::uint32_t& At(std::uintptr_t offset) const noexcept {
    return Register(base_ + offset);
  }
  void FeedTransmitter() noexcept;

  std::uintptr_t base_;
  std::uint32_t divider_;
  ByteRing<kReceiveCapacity> received_;
  ByteRing<kSendCapacity> to_send_;
  hal::LinkCounters counters_;
};

}  // namespace disflow::baremetal
