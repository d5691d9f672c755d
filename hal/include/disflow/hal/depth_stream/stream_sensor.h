// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "disflow/hal/byte_link.h"
#include "disflow/hal/clock.h"
#include "disflow/hal/depth_sensor.h"
#include "disflow/hal/depth_stream/packet_decoder.h"

namespace disflow::hal::depth_stream {

/// Depth images that arrive over a line, as a sensor. The sender waits for a DISFLOW_READY before
/// every frame; it is sent by Next() when it begins to wait, and again for every poll.
class StreamSensor final : public DepthSensor {
 public:
  /// @param image Memory for the pixels of one frame.
  /// @param budgets Where a sender's TimeBudgets go.
  StreamSensor(ByteLink& link, Clock& clock, std::span<std::uint16_t> image,
               TimeBudgets& budgets) noexcept
      : link_(link), clock_(clock), image_(image), budgets_(budgets) {}

  /// Component that DISFLOW_READY comes from: behind the last that an object can have.
  static constexpr std::uint8_t kComponentId = 68;

 private:
  enum class Outcome : std::uint8_t { kNothing, kFrame, kLost };
  enum class State : std::uint8_t { kIdle, kReceiving, kBroken, kRefused };

  Fault DoOpen() noexcept override { return link_.Open(); }
  Fault DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept override;
  void DoClose() noexcept override { link_.Close(); }
  [[nodiscard]] SensorInfo DoInfo() const noexcept override;
  [[nodiscard]] SensorCounters DoCounters() const noexcept override;

  [[nodiscard]] Outcome Handle(const PacketView& packet) noexcept;
  void Begin(const PacketView& packet) noexcept;
  [[nodiscard]] Outcome End(std::uint32_t sequence) noexcept;
  void Describe(DepthFrame& frame) const noexcept;
  void SendReady() noexcept;

  ByteLink& link_;
  Clock& clock_;
  std::span<std::uint16_t> image_;
  TimeBudgets& budgets_;
  PacketDecoder decoder_;
  std::array<std::byte, 64> chunk_{};
  std::size_t chunk_next_ = 0;
  std::size_t chunk_end_ = 0;
  State state_ = State::kIdle;
  FrameStart start_;
  std::uint32_t sequence_ = 0;  ///< Of the frame that is being received.
  std::uint32_t answered_ = 0;
  std::size_t next_pixel_ = 0;
  std::uint32_t frames_ = 0;
  std::uint32_t lost_ = 0;
  std::uint32_t refused_ = 0;
  std::uint8_t message_sequence_ = 0;
};

}  // namespace disflow::hal::depth_stream
