// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace disflow::apps {

/// Percentiles of durations in fixed memory, exact to 1 %.
class DurationHistogram {
 public:
  void Add(std::int64_t duration_ns) noexcept {
    const double ratio = static_cast<double>(std::max<std::int64_t>(duration_ns, 1)) / kShortest_ns;
    const double bin = std::floor(std::log(ratio) / std::log(kGrowth));
    ++bins_[static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(kBins - 1)))];
    ++count_;
  }

  /// @param share 0.5 = median. @return Milliseconds, 0 if nothing was added.
  [[nodiscard]] double Percentile_ms(double share) const noexcept {
    const double wanted = share * static_cast<double>(count_);
    std::int64_t seen = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      seen += bins_[bin];
      if (seen > 0 && static_cast<double>(seen) >= wanted) {
        return kShortest_ns * std::pow(kGrowth, static_cast<double>(bin) + 0.5) * 1e-6;
      }
    }
    return 0.0;
  }

 private:
  static constexpr std::size_t kBins = 2048;
  static constexpr double kShortest_ns = 1000.0;
  static constexpr double kGrowth = 1.01;  // 1 us to 700 s

  std::array<std::int64_t, kBins> bins_{};
  std::int64_t count_ = 0;
};

}  // namespace disflow::apps
