// SPDX-License-Identifier: BSD-3-Clause
#include "icp_registration.h"

#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/search/kdtree.h>

namespace disflow::bench {
namespace {

using Point = pcl::PointNormal;
using Generalised = pcl::GeneralizedIterativeClosestPoint<Point, Point, double>;
using PointToPlane = pcl::IterativeClosestPointWithNormals<Point, Point, double>;

constexpr int kMostIterations = 30;
/// A step below these ends the iteration: 0.05 mm, 0.03 degrees.
constexpr double kStep_m = 5e-5;
constexpr double kStep_rad = 5e-4;

/// A small disc: what PCL makes of the neighbours of a point, but from the normal that is known
/// already, so that neighbours are searched for once and those of the model never again.
Generalised::MatricesVectorPtr DiscsOf(const Cloud& cloud, double flatness) {
  Generalised::MatricesVectorPtr discs(new Generalised::MatricesVector);
  discs->reserve(cloud.size());
  for (const Point& point : cloud) {
    const Eigen::Vector3d normal = point.getNormalVector3fMap().cast<double>();
    discs->push_back(Eigen::Matrix3d::Identity() - (1.0 - flatness) * normal * normal.transpose());
  }
  return discs;
}

template <class Icp>
void Prepare(const Cloud::ConstPtr& source, const Cloud::ConstPtr& target,
             const IcpSettings& settings, Icp& icp) {
  icp.setMaxCorrespondenceDistance(static_cast<double>(settings.max_distance_m));
  icp.setMaximumIterations(kMostIterations);
  icp.setInputSource(source);
  icp.setInputTarget(target);
  // Nothing is searched for in the source, so its tree is not built.
  icp.setSearchMethodSource(
      typename pcl::search::KdTree<Point>::Ptr(new pcl::search::KdTree<Point>),
      /*force_no_recompute=*/true);
}

template <class Icp>
std::optional<Eigen::Matrix4d> Align(Icp& icp) {
  Cloud aligned;
  icp.align(aligned);
  const Eigen::Matrix4d motion = icp.getFinalTransformation();
  if (!icp.hasConverged() || !motion.allFinite()) return std::nullopt;
  return motion;
}

std::optional<Eigen::Matrix4d> RegisterGeneralised(const Cloud::ConstPtr& source,
                                                   const Cloud::ConstPtr& target,
                                                   const IcpSettings& settings) {
  Generalised icp;
  Prepare(source, target, settings, icp);
  icp.setSourceCovariances(DiscsOf(*source, settings.flatness));
  icp.setTargetCovariances(DiscsOf(*target, settings.flatness));
  icp.setTransformationEpsilon(kStep_m);
  icp.setRotationEpsilon(kStep_rad);
  // PCL's own, 0.01, ends at 0.2 degrees on objects of this size.
  icp.setTranslationGradientTolerance(1e-4);
  icp.setRotationGradientTolerance(1e-4);
  return Align(icp);
}

std::optional<Eigen::Matrix4d> RegisterPointToPlane(const Cloud::ConstPtr& source,
                                                    const Cloud::ConstPtr& target,
                                                    const IcpSettings& settings) {
  PointToPlane icp;
  Prepare(source, target, settings, icp);
  // PCL compares the square of the step and the cosine of the angle.
  icp.setTransformationEpsilon(kStep_m * kStep_m);
  icp.setTransformationRotationEpsilon(1.0 - 0.5 * kStep_rad * kStep_rad);
  return Align(icp);
}

}  // namespace

std::optional<Eigen::Matrix4d> RegisterByIcp(const Cloud::ConstPtr& source,
                                             const Cloud::ConstPtr& target,
                                             const IcpSettings& settings) {
  if (source->empty() || target->empty()) return std::nullopt;
  return settings.kind == IcpKind::kGeneralised ? RegisterGeneralised(source, target, settings)
                                                : RegisterPointToPlane(source, target, settings);
}

}  // namespace disflow::bench
