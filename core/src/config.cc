// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/config.h"

#include <type_traits>

#include "disflow/config_fields.h"

namespace disflow {

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
