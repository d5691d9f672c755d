// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/distance_query_input.h"

#include "disflow/saturating.h"

namespace disflow::hal::mavlink {

void DistanceQueryInput::Take(const FrameView& frame) noexcept {
  DisflowQuery query;
  if (DecodePayload(frame, query) != Status::kOk || query.target_system != system_id_) return;
  const bool has_sense = query.count > 0 && query.count <= DisflowQuery::kPoints;
  if (!has_sense || !waiting_.push_back(query)) AddSaturating(refused_);
}

}  // namespace disflow::hal::mavlink
