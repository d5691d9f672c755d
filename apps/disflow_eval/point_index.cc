// SPDX-License-Identifier: BSD-3-Clause
#include "point_index.h"

#include <cmath>
#include <nanoflann.hpp>

namespace disflow::apps {
namespace {

/// What nanoflann asks of a point list.
struct PointList {
  const std::vector<Vec3d>& points;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

}  // namespace

class PointIndex::Tree {
 public:
  explicit Tree(const std::vector<Vec3d>& points) : list_{points}, index_(3, list_) {}

  using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointList>,
                                                    PointList, 3, std::uint32_t>;
  [[nodiscard]] const Index& index() const { return index_; }

 private:
  PointList list_;
  Index index_;  // builds itself on construction
};

PointIndex::PointIndex(const std::vector<Vec3d>& points) : tree_(std::make_unique<Tree>(points)) {}
PointIndex::~PointIndex() = default;

double PointIndex::NearestDistance(const Vec3d& query) const {
  std::uint32_t index = 0;
  double squared = 0.0;
  tree_->index().knnSearch(query.data(), 1, &index, &squared);
  return std::sqrt(squared);
}

void PointIndex::Nearest(const Vec3d& query, std::size_t count,
                         std::vector<std::uint32_t>& nearest) const {
  thread_local std::vector<double> squared;
  nearest.resize(count);
  squared.resize(count);
  nearest.resize(tree_->index().knnSearch(query.data(), count, nearest.data(), squared.data()));
}

}  // namespace disflow::apps
