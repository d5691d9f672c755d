// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>

#include "object_cloud.h"

namespace disflow::bench {

/// All points of the object that were ever seen: per voxel and side of a surface the means of
/// position and normal.
class VoxelModel {
 public:
  explicit VoxelModel(float voxel_m) : voxel_m_(voxel_m) {}

  /// @param cloud In the object frame, with normals.
  void Add(const Cloud& cloud);

  /// What of the model faces a camera at `eye_m`, both in the object frame: no other part can be
  /// what the camera sees.
  [[nodiscard]] Cloud::Ptr Facing(const Eigen::Vector3f& eye_m) const;

 private:
  /// Indices of the voxel, and which side of a thin wall.
  using Key = std::array<int, 4>;
  struct Hash {
    std::size_t operator()(const Key& key) const noexcept;
  };
  struct Cell {
    Eigen::Matrix<float, 3, 1, Eigen::DontAlign> points{0.0F, 0.0F, 0.0F};   ///< Sum.
    Eigen::Matrix<float, 3, 1, Eigen::DontAlign> normals{0.0F, 0.0F, 0.0F};  ///< Sum.
    float count = 0.0F;
  };

  float voxel_m_;
  std::unordered_map<Key, Cell, Hash> cells_;
};

}  // namespace disflow::bench
