// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "disflow/host/object_meshes.h"
#include "disflow/host/open_sensor.h"
#include "image_reducer.h"
#include "profile.h"

namespace disflow::firmware_test {

/// A frame as the controller gets it, and the truth.
struct Frame {
  std::vector<std::uint16_t> pixels;
  DepthFrame frame;  ///< Its data pointer is set by View().
  Transform<Camera, Object, double> T_co;

  [[nodiscard]] DepthFrame View() const {
    DepthFrame view = frame;
    view.depth.data = pixels.data();
    return view;
  }
};

/// A simulated sequence, reduced to a size that the firmware takes.
inline std::vector<Frame> MakeSequence(const std::string& object, const std::string& noise,
                                       int count,
                                       int max_width_px = firmware::Profile::kMaxImageWidth,
                                       int max_height_px = firmware::Profile::kMaxImageHeight) {
  host::Sensor sensor;
  const hal::Fault fault = host::OpenSensor("sim:" + object + "?motion=fast&noise=" + noise +
                                                "&width=640&height=360&mask=none&seed=1&frames=300",
                                            sensor);
  if (!fault.ok()) throw std::runtime_error(fault.message);
  apps::ImageReducer reducer(max_width_px, max_height_px);
  std::vector<Frame> frames;
  DepthFrame frame;
  while (static_cast<int>(frames.size()) < count && sensor.get()->Next(1'000'000'000, frame).ok()) {
    const DepthFrame reduced = reducer.Reduce(frame);
    const auto* const begin = static_cast<const std::uint16_t*>(reduced.depth.data);
    const auto size = static_cast<std::size_t>(reduced.depth.width_px) *
                      static_cast<std::size_t>(reduced.depth.height_px);
    frames.push_back({{begin, begin + size}, reduced, sensor.simulated()->truth().object.pose});
  }
  return frames;
}

/// Area under the share of frames against the threshold of ADD, up to 0.10 m, in percent. Estimates
/// are aligned with the truth at the first frame.
inline double AddAuc(const std::vector<Frame>& frames,
                     const std::vector<PoseCameraFromObject>& poses,
                     const host::TriangleMesh& model) {
  constexpr double kLimit_m = 0.1;
  constexpr int kPoints = 500;
  const std::vector<host::Vec3d> points = host::SampleSurface(model, kPoints);
  // Estimated object's frame from the true one's.
  const auto T_et = poses.at(0).Cast<double>().Inverse() * frames.at(0).T_co;
  double sum = 0.0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto estimated = poses.at(i).Cast<double>() * T_et;
    double add_m = 0.0;
    for (const host::Vec3d& x : points) add_m += (estimated * x - frames[i].T_co * x).norm();
    sum += std::max(0.0, 1.0 - add_m / static_cast<double>(points.size()) / kLimit_m);
  }
  return 100.0 * sum / static_cast<double>(frames.size());
}

}  // namespace disflow::firmware_test
