// SPDX-License-Identifier: BSD-3-Clause
#include "settings/camera_in_body.h"

namespace disflow::apps {

Transform<hal::Body, Camera, double> CameraInBody(const CameraPoseOptions& options) {
  // Optical axes (right, down, forward) in a body's (forward, right, down).
  std::vector<double> numbers = {0.0, 0.0, 0.0, 0.5, 0.5, 0.5, 0.5};
  if (!options.camera_in_body.empty()) numbers = options.camera_in_body;
  const Eigen::Quaternion<double, Eigen::DontAlign> q(numbers[3], numbers[4], numbers[5],
                                                      numbers[6]);
  return {q, Mat<double, 3>(numbers[0], numbers[1], numbers[2])};
}

}  // namespace disflow::apps
