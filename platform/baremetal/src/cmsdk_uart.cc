// SPDX-License-Identifier: BSD-3-Clause
#include "cmsdk_uart.h"

#include "disflow/baremetal/startup.h"
#include "disflow/saturating.h"

namespace disflow::baremetal {
namespace {

constexpr std::uintptr_t kData = 0x00;
constexpr std::uintptr_t kState = 0x04;
constexpr std::uintptr_t kControl = 0x08;
constexpr std::uintptr_t kInterrupt = 0x0C;
constexpr std::uintptr_t kDivider = 0x10;

constexpr std::uint32_t kSendFull = 1U << 0U;
constexpr std::uint32_t kReceiveFull = 1U << 1U;
constexpr std::uint32_t kReceiveOverrun = 1U << 3U;
constexpr std::uint32_t kSendInterrupt = 1U << 0U;
constexpr std::uint32_t kReceiveInterrupt = 1U << 1U;
constexpr std::uint32_t kOn = 0x0F;  // both directions, both interrupts

}  // namespace

hal::Fault CmsdkUart::DoOpen() noexcept {
  At(kDivider) = divider_;
  At(kControl) = kOn;
  return {};
}

void CmsdkUart::DoClose() noexcept { At(kControl) = 0; }

hal::Fault CmsdkUart::DoSend(std::span<const std::byte> message) noexcept {
  if (message.size() > to_send_.free()) {
    AddSaturating(counters_.dropped_messages);
    return {.status = Status::kWouldBlock};
  }
  // There was room, and only this fills the ring.
  for (const std::byte byte : message) (void)to_send_.Push(byte);
  AddSaturating(counters_.sent_messages);
  AddSaturating(counters_.sent_bytes, message.size());
  const InterruptLock lock;
  FeedTransmitter();
  return {};
}

Expected<std::size_t> CmsdkUart::DoReceive(std::span<std::byte> buffer) noexcept {
  std::size_t size = 0;
  while (size < buffer.size() && received_.Pop(buffer[size])) ++size;
  AddSaturating(counters_.received_bytes, size);
  return {size};
}

bool CmsdkUart::idle() const noexcept {
  return to_send_.free() == kSendCapacity && (At(kState) & kSendFull) == 0;
}

void CmsdkUart::OnReceive() noexcept {
  At(kInterrupt) = kReceiveInterrupt;
  if ((At(kState) & kReceiveOverrun) != 0) {
    At(kState) = kReceiveOverrun;
    AddSaturating(counters_.overrun_bytes);
  }
  while ((At(kState) & kReceiveFull) != 0) {
    const auto byte = static_cast<std::byte>(At(kData) & 0xFFU);
    if (!received_.Push(byte)) AddSaturating(counters_.overrun_bytes);
  }
}

void CmsdkUart::OnTransmit() noexcept {
  At(kInterrupt) = kSendInterrupt;
  FeedTransmitter();
}

/// The interrupt comes when a byte leaves a full transmitter; so it has to be fed once from
/// outside.
void CmsdkUart::FeedTransmitter() noexcept {
  std::byte byte;
  while ((At(kState) & kSendFull) == 0 && to_send_.Pop(byte)) {
    At(kData) = std::to_integer<std::uint32_t>(byte);
  }
}

}  // namespace disflow::baremetal
