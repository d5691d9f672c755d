// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_model.h"

#include <cmath>
#include <cstdint>

namespace disflow::bench {

std::size_t VoxelModel::Hash::operator()(const Key& key) const noexcept {
  // FNV-1a, by whole numbers.
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const int index : key) {
    hash = (hash ^ static_cast<std::uint32_t>(index)) * 0x100000001b3ULL;
  }
  return static_cast<std::size_t>(hash ^ (hash >> 29U));
}

void VoxelModel::Add(const Cloud& cloud) {
  for (const pcl::PointNormal& point : cloud) {
    const Eigen::Vector3f normal = point.getNormalVector3fMap();
    Key key{};
    for (std::size_t i = 0; i < 3; ++i)
      key[i] = static_cast<int>(std::floor(point.data[i] / voxel_m_));
    const auto front = cells_.find(key);
    if (front != cells_.end() && front->second.normals.dot(normal) < 0.0F) key[3] = 1;
    Cell& cell = cells_[key];
    cell.points += point.getVector3fMap();
    cell.normals += normal;
    cell.count += 1.0F;
  }
}

Cloud::Ptr VoxelModel::Facing(const Eigen::Vector3f& eye_m) const {
  Cloud::Ptr cloud(new Cloud);
  for (const auto& [key, cell] : cells_) {
    pcl::PointNormal point;
    point.getVector3fMap() = cell.points / cell.count;
    point.getNormalVector3fMap() = cell.normals.normalized();
    if (point.getNormalVector3fMap().dot(eye_m - point.getVector3fMap()) > 0.0F)
      cloud->push_back(point);
  }
  return cloud;
}

}  // namespace disflow::bench
