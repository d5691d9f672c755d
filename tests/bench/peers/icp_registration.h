// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "icp_settings.h"
#include "object_cloud.h"

namespace disflow::bench {

/// Registers one cloud to another by PCL, starting from where it is. Both have normals and lie
/// around the origin, so that float and the steps of the optimiser lose nothing.
/// @return The motion that takes source onto target; nothing if ICP did not converge.
[[nodiscard]] std::optional<Eigen::Matrix4d> RegisterByIcp(const Cloud::ConstPtr& source,
                                                           const Cloud::ConstPtr& target,
                                                           const IcpSettings& settings);

}  // namespace disflow::bench
