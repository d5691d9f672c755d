// SPDX-License-Identifier: BSD-3-Clause
#include "view/view_texts.h"

#include <nlohmann/json.hpp>
#include <type_traits>

#include "disflow/config_fields.h"
#include "program/counter_names.h"
#include "view/view_messages.h"

namespace disflow::apps {
namespace {

using Json = nlohmann::ordered_json;

template <class Names, class Counters>
Json ToJson(const Names& names, const Counters& counters) {
  Json json = Json::object();
  for (const auto& name : names) json[name.words] = counters.*name.member;
  return json;
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
                {"tracker", ToJson(kTrackerCounters, result.totals)},
                {"sensor", ToJson(kSensorCounters, result.sensor)}});
}

std::string DescribeRunningSettings(const Config& config) {
  Json settings = Json::array();
  std::size_t number = 0;
  VisitFields(config, [&](const auto& field) {
    const std::size_t own = number++;
    if (!field.at_run_time) return;
    using Value = std::remove_cvref_t<decltype(field.value)>;
    settings.push_back({{"number", own},
                        {"name", field.name},
                        {"value", field.value},
                        {"min", field.min},
                        {"max", field.max},
                        {"whole", std::is_integral_v<Value>},
                        {"unit", field.unit},
                        {"meaning", field.meaning}});
  });
  return Print({{"settings", std::move(settings)}});
}

}  // namespace disflow::apps
