// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstring>

#include "disflow/hal/mavlink/distance_query_input.h"
#include "file_in_memory.h"
#include "message_line.h"

/// Payloads of DISFLOW_QUERY with right checksums, so that the fuzzer gets behind the decoder: what
/// waits can always be answered, and the answer always fits into a frame.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace disflow;
  using namespace disflow::hal;
  mavlink::DistanceQueryInput input;
  test::MessageLine line(input);
  constexpr std::size_t kPiece = 127;
  for (; size > 0; data += std::min(size, kPiece), size -= std::min(size, kPiece)) {
    mavlink::FrameView view;
    view.message_id = mavlink::DisflowQuery::kId;
    view.payload = std::as_bytes(std::span(data, std::min(size, kPiece)));
    mavlink::DisflowQuery query;
    fuzz::Require(mavlink::DecodePayload(view, query) == Status::kOk);
    if (size % 2 == 0) query.target_system = 190;
    std::array<std::byte, mavlink::kMaxFrameSize> buffer{};
    const auto encoded =
        mavlink::EncodeFrame(query, {.sequence = 0, .system_id = 1, .component_id = 1}, buffer);
    line.Deliver(std::span(buffer).first(encoded.value));
    for (const mavlink::DisflowQuery& waiting : input.waiting()) {
      fuzz::Require(waiting.count > 0 && waiting.count <= mavlink::DisflowQuery::kPoints);
      int asked = 0;
      const mavlink::DisflowField field =
          mavlink::AnswerQuery(waiting, 0, [&asked](const Vec3& x_m) {
            ++asked;
            Expected<DistanceQuery> answer;
            answer.status = x_m.allFinite() ? Status::kOk : Status::kOutOfBounds;
            return answer;
          });
      fuzz::Require(asked == field.count);
      fuzz::Require(mavlink::EncodeFrame(field, {}, buffer).ok());
    }
    if (data[0] % 3 == 0) input.Clear();
  }
  return 0;
}
