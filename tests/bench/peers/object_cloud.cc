// SPDX-License-Identifier: BSD-3-Clause
#include "object_cloud.h"

#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "disflow/config.h"
#include "disflow/depth/depth_reader.h"
#include "object_interior.h"

namespace disflow::bench {
namespace {

using Point = pcl::PointNormal;

Cloud::Ptr BackProject(const DepthFrame& frame) {
  const DepthReader depth(frame.depth, 0.0F, std::numeric_limits<float>::max());
  Cloud::Ptr cloud(new Cloud);
  for (int v = 0; v < depth.height_px(); ++v) {
    for (int u = 0; u < depth.width_px(); ++u) {
      const float depth_m = depth.At(u, v);
      if (depth_m <= 0.0F || !IsInterior(frame.mask, u, v)) continue;
      Point point;
      point.getVector3fMap() =
          frame.camera.BackProject(static_cast<float>(u), static_cast<float>(v), depth_m);
      cloud->push_back(point);
    }
  }
  return cloud;
}

bool IsSeenWell(const Point& point) {
  const Eigen::Vector3f to_camera = -point.getVector3fMap().normalized();
  const float cos_incidence = point.getNormalVector3fMap().dot(to_camera);
  return std::isfinite(cos_incidence) && cos_incidence >= SamplerConfig{}.min_cos_incidence;
}

}  // namespace

Cloud::Ptr MakeObjectCloud(const DepthFrame& frame, const IcpSettings& settings) {
  Cloud::Ptr cloud(new Cloud);
  pcl::VoxelGrid<Point> filter;
  filter.setInputCloud(BackProject(frame));
  filter.setLeafSize(settings.voxel_m, settings.voxel_m, settings.voxel_m);
  filter.setDownsampleAllData(false);
  filter.filter(*cloud);
  if (static_cast<int>(cloud->size()) < settings.neighbours) return Cloud::Ptr(new Cloud);
  // The camera is at the origin, which normals are turned to unless told otherwise.
  pcl::NormalEstimation<Point, Point> normals;
  normals.setInputCloud(cloud);
  normals.setSearchMethod(pcl::search::KdTree<Point>::Ptr(new pcl::search::KdTree<Point>(false)));
  normals.setKSearch(settings.neighbours);
  normals.compute(*cloud);
  std::erase_if(cloud->points, [](const Point& point) { return !IsSeenWell(point); });
  cloud->resize(cloud->points.size());
  return cloud;
}

}  // namespace disflow::bench
