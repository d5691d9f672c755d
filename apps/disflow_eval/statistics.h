// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace disflow::apps {

/// What a list of values looks like; NaN throughout if it is empty.
struct Statistics {
  std::size_t count = 0;
  double mean = 0.0;
  double rms = 0.0;
  double median = 0.0;
  double p95 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

[[nodiscard]] Statistics Summarise(std::vector<double> values);

/// Value below which the share `q` (0..1) of a sorted list lies, linear between neighbours.
[[nodiscard]] double Quantile(const std::vector<double>& sorted, double q);

/// Area under acc(d), the share of `frame_count` frames whose error is below d, for d from 0 to
/// `limit`, divided by `limit`: the exact integral of the paper's section VI, without bins.
/// Frames without an error value count as never accurate.
[[nodiscard]] double AreaUnderAccuracy(const std::vector<double>& errors, std::size_t frame_count,
                                       double limit);

}  // namespace disflow::apps
