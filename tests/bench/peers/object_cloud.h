// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "disflow/depth/depth_frame.h"
#include "icp_settings.h"

namespace disflow::bench {

using Cloud = pcl::PointCloud<pcl::PointNormal>;

/// The object in one depth image: mask without its border, back-projected, one point per voxel,
/// with normals towards the camera. Points that are seen at too flat an angle are left out, as the
/// tracker does.
/// @return In the camera frame, metres; never null, empty if nothing of the object is seen.
[[nodiscard]] Cloud::Ptr MakeObjectCloud(const DepthFrame& frame, const IcpSettings& settings);

}  // namespace disflow::bench
