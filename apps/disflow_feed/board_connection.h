// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/byte_link.h"
#include "disflow/hal/clock.h"
#include "disflow/hal/depth_stream/packet.h"
#include "disflow/hal/mavlink/frame_decoder.h"

namespace disflow::apps {

/// What a controller said of one frame.
struct BoardAnswer {
  bool tracked = false;  ///< ODOMETRY came; false: the board got no whole frame.
  hal::mavlink::Odometry odometry;
  hal::mavlink::DisflowStatus status;
  hal::mavlink::DisflowTiming timing;
  hal::mavlink::DisflowReady ready;
};

/// The host's end of the line to a controller that runs disflow_firmware.
class BoardConnection {
 public:
  /// @param link Open.
  BoardConnection(hal::ByteLink& link, hal::Clock& clock) : link_(link), clock_(clock) {}

  /// Waits until the controller answers.
  /// @return kOk, kTimeout or what the link says.
  [[nodiscard]] hal::Fault WaitUntilReady(std::int64_t timeout_ns);
  [[nodiscard]] hal::Fault SetBudgets(const hal::depth_stream::TimeBudgets& budgets);
  /// Sends a frame and waits for the answer.
  /// @param frame Of DepthFormat::kUint16.
  /// @return As WaitUntilReady().
  [[nodiscard]] hal::Fault Track(const DepthFrame& frame, std::int64_t timeout_ns,
                                 BoardAnswer& answer);
  /// The packets of a frame, one after the other.
  [[nodiscard]] static std::vector<std::vector<std::byte>> Packets(const DepthFrame& frame,
                                                                   std::uint32_t sequence);
  /// As Track() would send it now.
  [[nodiscard]] std::vector<std::vector<std::byte>> NextPackets(const DepthFrame& frame) const {
    return Packets(frame, sequence_ + 1);
  }
  /// Sends bytes as they are and waits for the answer to the frame that they make up.
  [[nodiscard]] hal::Fault TrackPackets(const std::vector<std::vector<std::byte>>& packets,
                                        std::int64_t timeout_ns, BoardAnswer& answer);

  /// Waits for the answer to a frame that reached the controller by some other way than this line.
  [[nodiscard]] hal::Fault AwaitRecorded(std::uint32_t sequence, std::int64_t timeout_ns,
                                         BoardAnswer& answer);

  [[nodiscard]] const hal::mavlink::DecoderCounters& counters() const {
    return decoder_.counters();
  }

 private:
  [[nodiscard]] hal::Fault SendAll(std::span<const std::byte> bytes);
  /// Until the controller is ready after the frame or poll with the last sequence number.
  [[nodiscard]] hal::Fault Await(std::int64_t timeout_ns, bool poll, BoardAnswer& answer);
  /// Takes what has arrived, up to the awaited DISFLOW_READY. @param ready Whether it was there.
  [[nodiscard]] hal::Fault Receive(BoardAnswer& answer, bool& ready);
  /// @return Whether this was the awaited DISFLOW_READY.
  [[nodiscard]] bool Take(const hal::mavlink::FrameView& frame, BoardAnswer& answer) const;

  hal::ByteLink& link_;
  hal::Clock& clock_;
  hal::mavlink::FrameDecoder decoder_;
  std::array<std::byte, 1024> received_{};
  std::span<const std::byte> rest_;  ///< Of received_, not decoded yet.
  std::uint32_t sequence_ = 0;       ///< Of the frame or poll that was sent last.
  std::uint32_t awaited_ = 0;        ///< Of the frame or poll that is to be answered.
};

}  // namespace disflow::apps
