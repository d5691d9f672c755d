// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "program/frame_result.h"

namespace disflow::apps {

/// The run in numbers for those who watch many machines: what a scraper of Prometheus gets from
/// /metrics. Thread-safe.
class RunMetrics {
 public:
  RunMetrics(std::string version, std::vector<std::string> objects);

  /// The next result of an object.
  void Add(std::size_t object, const FrameResult& result);
  /// @param lost Results of the object that were never added; a total.
  void SetLost(std::size_t object, std::uint32_t lost);

  /// All of it in Prometheus' text format 0.0.4.
  [[nodiscard]] std::string Text() const;

 private:
  /// Upper ends of the histogram's buckets: powers of about 2 around a frame's 33 ms.
  static constexpr std::array<double, 9> kBuckets_s = {0.0005, 0.001, 0.002, 0.005, 0.01,
                                                       0.02,   0.033, 0.05,  0.1};

  struct Object {
    std::string name;
    FrameResult newest;
    bool has_result = false;
    std::uint64_t restarts = 0;
    std::uint32_t lost = 0;
    std::array<std::uint64_t, kBuckets_s.size() + 1> buckets{};  ///< The last one has no end.
    double total_s = 0.0;
  };

  const std::string version_;
  mutable std::mutex mutex_;
  std::vector<Object> objects_;
};

}  // namespace disflow::apps
