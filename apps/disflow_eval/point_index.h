// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "frames.h"

namespace disflow::apps {

/// k-d tree over a list of points.
class PointIndex {
 public:
  /// @param points Must not be empty and must outlive the index, unchanged.
  explicit PointIndex(const std::vector<Vec3d>& points);
  ~PointIndex();
  PointIndex(const PointIndex&) = delete;
  PointIndex& operator=(const PointIndex&) = delete;

  /// Distance from `query` to the nearest point.
  [[nodiscard]] double NearestDistance(const Vec3d& query) const;

  /// Positions in the list of the `count` points nearest to `query` (fewer if there are fewer),
  /// nearest first.
  void Nearest(const Vec3d& query, std::size_t count, std::vector<std::uint32_t>& nearest) const;

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace disflow::apps
