// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/config.h"

#include <type_traits>

#include "disflow/config_fields.h"

namespace disflow {
namespace {

/// Half a pixel or half a region chooses nothing: the other half is named.
ConfigIssue HalfOfAStart(const ObjectStart& start) noexcept {
  const auto missing = [](const char* name, int value, int min, int max) {
    return ConfigIssue{name, static_cast<double>(value), static_cast<double>(min),
                       static_cast<double>(max)};
  };
  const bool has_region =
      start.roi_x_px > 0 || start.roi_y_px > 0 || start.roi_width_px > 0 || start.roi_height_px > 0;
  if (start.seed_u_px < 0 && start.seed_v_px >= 0)
    return missing("segmenter.seed_u_px", start.seed_u_px, 0, 8191);
  if (start.seed_v_px < 0 && start.seed_u_px >= 0)
    return missing("segmenter.seed_v_px", start.seed_v_px, 0, 8191);
  if (has_region && start.roi_width_px == 0)
    return missing("segmenter.roi_width_px", start.roi_width_px, 1, 8192);
  if (has_region && start.roi_height_px == 0)
    return missing("segmenter.roi_height_px", start.roi_height_px, 1, 8192);
  return {};
}

}  // namespace

ConfigIssue Validate(const Config& config) noexcept {
  ConfigIssue issue;
  VisitFields(config, [&issue](const auto& field) {
    // Limits in the setting's own precision, so that both ends are included. Written so that NaN
    // fails too.
    using Value = std::remove_cvref_t<decltype(field.value)>;
    const bool allowed = field.value >= static_cast<Value>(field.min) &&
                         field.value <= static_cast<Value>(field.max);
    if (issue.field == nullptr && !allowed) {
      issue = {field.name, static_cast<double>(field.value), field.min, field.max};
    }
  });
  const auto require = [&issue](bool fits, const ConfigIssue& conflict) {
    if (issue.field == nullptr && !fits) issue = conflict;
  };
  require(config.segmenter.max_range_m > config.segmenter.min_range_m,
          {"segmenter.max_range_m", static_cast<double>(config.segmenter.max_range_m),
           static_cast<double>(config.segmenter.min_range_m), 100.0});
  require(config.sampler.max_block_px >= config.sampler.min_block_px,
          {"sampler.max_block_px", static_cast<double>(config.sampler.max_block_px),
           static_cast<double>(config.sampler.min_block_px), 64.0});
  const ConfigIssue start = HalfOfAStart(config.segmenter);
  require(start.field == nullptr, start);
  // Samples of the model lie as far apart as they are merged: nearer than that most have no match.
  require(config.registration.match_radius_m >= config.field.merge_radius_m,
          {"registration.match_radius_m", static_cast<double>(config.registration.match_radius_m),
           static_cast<double>(config.field.merge_radius_m), 1.0});
  return issue;
}

Config AdjustedAtRunTime(const Config& now, const Config& wanted) noexcept {
  Config adjusted = wanted;
  static_cast<ObjectStart&>(adjusted.segmenter) = now.segmenter;
  adjusted.field = now.field;
  adjusted.field.retrain_budget = wanted.field.retrain_budget;
  adjusted.field.fuse_budget = wanted.field.fuse_budget;
  return adjusted;
}

}  // namespace disflow
