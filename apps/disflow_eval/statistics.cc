// SPDX-License-Identifier: BSD-3-Clause
#include "statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace disflow::apps {

double Quantile(const std::vector<double>& sorted, double q) {
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double position = std::clamp(q, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - std::floor(position));
}

Statistics Summarise(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  const auto n = static_cast<double>(values.size());
  return {values.size(),          sum / n,
          std::sqrt(squares / n), Quantile(values, 0.5),
          Quantile(values, 0.95), Quantile(values, 0.99),
          Quantile(values, 1.0)};
}

double AreaUnderAccuracy(const std::vector<double>& errors, std::size_t frame_count, double limit) {
  // A frame with error e is accurate for every d > e: it adds (limit - e) / limit.
  double sum = 0.0;
  for (const double error : errors) sum += std::max(0.0, 1.0 - error / limit);
  return sum / static_cast<double>(frame_count);
}

}  // namespace disflow::apps
