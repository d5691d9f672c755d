// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_model.h"

#include <gtest/gtest.h>

namespace disflow::bench {
namespace {

pcl::PointNormal PointOf(const Eigen::Vector3f& position, const Eigen::Vector3f& normal) {
  pcl::PointNormal point;
  point.getVector3fMap() = position;
  point.getNormalVector3fMap() = normal;
  return point;
}

Cloud CloudOf(const pcl::PointNormal& point) {
  Cloud cloud;
  cloud.push_back(point);
  return cloud;
}

const Eigen::Vector3f kFront(0.0F, 0.0F, -1.0F);
const Eigen::Vector3f kEye(0.0F, 0.0F, -0.5F);

TEST(VoxelModel, PointsOfOneVoxel_BecomeTheirMean) {
  VoxelModel model(0.003F);
  model.Add(CloudOf(PointOf({0.001F, 0.001F, 0.001F}, kFront)));
  model.Add(CloudOf(PointOf({0.002F, 0.002F, 0.001F}, kFront)));
  const Cloud::Ptr cloud = model.Facing(kEye);
  ASSERT_EQ(cloud->size(), 1U);
  EXPECT_NEAR(cloud->front().x, 0.0015F, 1e-7F);
  EXPECT_NEAR(cloud->front().z, 0.001F, 1e-7F);
}

TEST(VoxelModel, VoxelsOnBothSidesOfZero_AreTwo) {
  VoxelModel model(0.003F);
  model.Add(CloudOf(PointOf({0.001F, 0.0F, 0.0F}, kFront)));
  model.Add(CloudOf(PointOf({-0.001F, 0.0F, 0.0F}, kFront)));
  EXPECT_EQ(model.Facing(kEye)->size(), 2U);
}

TEST(VoxelModel, SurfaceThatFacesAway_IsLeftOut) {
  VoxelModel model(0.003F);
  model.Add(CloudOf(PointOf({0.0F, 0.0F, 0.0F}, kFront)));
  model.Add(CloudOf(PointOf({0.0F, 0.0F, 0.1F}, -kFront)));
  EXPECT_EQ(model.Facing(kEye)->size(), 1U);
  EXPECT_EQ(model.Facing(-kEye)->size(), 1U);
}

TEST(VoxelModel, BothSidesOfAThinWallInOneVoxel_AreKeptApart) {
  VoxelModel model(0.003F);
  for (int i = 0; i < 3; ++i) {
    model.Add(CloudOf(PointOf({0.001F, 0.001F, 0.0005F}, kFront)));
    model.Add(CloudOf(PointOf({0.001F, 0.001F, 0.0025F}, -kFront)));
  }
  const Cloud::Ptr front = model.Facing(kEye);
  ASSERT_EQ(front->size(), 1U);
  EXPECT_NEAR(front->front().z, 0.0005F, 1e-7F);
  const Cloud::Ptr back = model.Facing(-kEye);
  ASSERT_EQ(back->size(), 1U);
  EXPECT_NEAR(back->front().z, 0.0025F, 1e-7F);
}

}  // namespace
}  // namespace disflow::bench
