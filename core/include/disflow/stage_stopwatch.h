// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/estimate.h"

namespace disflow {

/// Books the time since the last mark to a stage, if the caller lent a clock.
class StageStopwatch {
 public:
  StageStopwatch(StageClock clock, Estimate& estimate) noexcept
      : clock_(clock), estimate_(estimate) {
    estimate_.stage_ns.fill(0);
    if (clock_.now_ns != nullptr) last_ns_ = clock_.now_ns(clock_.context);
  }
  void Mark(Stage stage) noexcept {
    if (clock_.now_ns == nullptr) return;
    const std::int64_t now_ns = clock_.now_ns(clock_.context);
    estimate_.stage_ns[static_cast<std::size_t>(stage)] += now_ns - last_ns_;
    last_ns_ = now_ns;
  }

 private:
  StageClock clock_;
  Estimate& estimate_;
  std::int64_t last_ns_ = 0;
};

}  // namespace disflow
