// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstring>

#include "disflow/hal/mavlink/camera_pose_input.h"
#include "file_in_memory.h"
#include "message_line.h"

/// Payloads of ODOMETRY with right checksums, so that the fuzzer gets behind the decoder; after
/// each, the camera's pose is asked for at a stamp of the fuzzer's.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace disflow;
  using namespace disflow::hal;
  CameraPoseHistory history({});
  mavlink::CameraPoseInput same({.system_id = 1}, history);
  mavlink::CameraPoseInput own({.system_id = 1, .own_clock = true}, history);
  test::MessageLine same_line(same);
  test::MessageLine own_line(own);
  constexpr std::size_t kHead = 9;
  constexpr std::size_t kPiece = kHead + 233;
  for (; size > kHead; data += std::min(size, kPiece), size -= std::min(size, kPiece)) {
    std::int64_t now_ns = 0;
    std::memcpy(&now_ns, data, sizeof(now_ns));
    mavlink::FrameView view;
    view.message_id = mavlink::Odometry::kId;
    view.payload = std::as_bytes(std::span(data + kHead, std::min(size, kPiece) - kHead));
    mavlink::Odometry odometry;
    fuzz::Require(mavlink::DecodePayload(view, odometry) == Status::kOk);
    odometry.frame_id = data[8] % 8 == 0 ? odometry.frame_id : std::uint8_t{20};
    std::array<std::byte, mavlink::kMaxFrameSize> buffer{};
    const auto encoded =
        mavlink::EncodeFrame(odometry, {.sequence = 0, .system_id = 1, .component_id = 1}, buffer);
    // A clock starts at 0 and never gets to the end of its numbers.
    now_ns = static_cast<std::int64_t>(static_cast<std::uint64_t>(now_ns) >> 3U);
    (data[8] % 2 == 0 ? same_line : own_line)
        .Deliver(std::span(buffer).first(encoded.value), now_ns);
    Transform<World, Camera> T_wc;
    if (history.At(now_ns, T_wc) == Status::kOk) (void)T_wc.IsFinite();
  }
  return 0;
}
