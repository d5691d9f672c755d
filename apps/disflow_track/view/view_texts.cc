// SPDX-License-Identifier: BSD-3-Clause
#include "view/view_texts.h"

#include <nlohmann/json.hpp>

#include "view/view_messages.h"

namespace disflow::apps {
namespace {

using Json = nlohmann::ordered_json;

Json CountersOf(const Counters& totals) {
  return {{"frames", totals.frames},
          {"frames refused", totals.frames_rejected},
          {"frames predicted only", totals.frames_unregistered},
          {"images repeated", totals.images_repeated},
          {"pixels out of range", totals.pixels_out_of_range},
          {"pixel runs dropped", totals.runs_dropped},
          {"blocks sparse", totals.blocks_sparse},
          {"blocks grazing", totals.blocks_grazing},
          {"blocks flying", totals.blocks_flying},
          {"samples dropped", totals.samples_dropped},
          {"residuals unmatched", totals.residuals_unmatched},
          {"residuals truncated", totals.residuals_truncated},
          {"normals that disagree", totals.residuals_normal_mismatch},
          {"observations rejected", totals.observations_rejected},
          {"observations out of bounds", totals.observations_out_of_bounds},
          {"model samples refused", totals.samples_refused},
          {"clusters evicted", totals.clusters_evicted},
          {"edges refused", totals.edges_refused},
          {"GP candidates dropped", totals.candidates_dropped}};
}

Json CountersOf(const hal::SensorCounters& sensor) {
  return {{"delivered", sensor.frames},
          {"dropped", sensor.dropped},
          {"corrupt", sensor.corrupt},
          {"stream restarts", sensor.restarts},
          {"reconnects", sensor.reconnects}};
}

/// Wrong UTF-8, which a name from a command line may hold, is replaced.
std::string Print(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string DescribeProgram(const std::string& version, std::span<const std::string> objects) {
  Json json = {{"format", kViewFormat}, {"version", version}, {"objects", objects}};
  for (int i = 0; i <= static_cast<int>(TrackingState::kRecovered); ++i) {
    json["states"].push_back(Name(static_cast<TrackingState>(i)));
  }
  for (int i = 0; i <= static_cast<int>(WeakKind::kRotation); ++i) {
    json["weak"].push_back(Name(static_cast<WeakKind>(i)));
  }
  for (int i = 0; i < kStageCount; ++i) json["stages"].push_back(Name(static_cast<Stage>(i)));
  for (int i = 0; i <= static_cast<int>(Status::kNotOpen); ++i) {
    json["statuses"].push_back(Describe(static_cast<Status>(i)));
  }
  return Print(json);
}

std::string DescribeStatus(const ViewStatus& status, const FrameResult& result) {
  return Print({{"paused", status.paused},
                {"ended", status.ended},
                {"frames_per_second", status.frames_per_second},
                {"not_shown", status.not_shown},
                {"tracker", CountersOf(result.totals)},
                {"sensor", CountersOf(result.sensor)}});
}

}  // namespace disflow::apps
