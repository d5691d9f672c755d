// SPDX-License-Identifier: BSD-3-Clause
#include "surface_calibration.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace disflow::apps {
namespace {

constexpr std::size_t kBins = 10;

using Bin = SurfaceCalibration::Bin;

Bin RootMeanSquares(std::span<const Bin> vertices) {
  Bin sum;
  for (const Bin& vertex : vertices) {
    sum.std_m += vertex.std_m * vertex.std_m;
    sum.error_m += vertex.error_m * vertex.error_m;
  }
  const auto count = static_cast<double>(vertices.size());
  return {std::sqrt(sum.std_m / count), std::sqrt(sum.error_m / count)};
}

}  // namespace

std::optional<SurfaceCalibration> CalibrateSurface(const Surface& mesh, const NearestSurface& model,
                                                   const std::vector<bool>& model_seen) {
  if (mesh.stds_m.empty()) return std::nullopt;
  std::vector<Bin> vertices;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const NearestSurface::Hit hit = model.Find(mesh.vertices[i]);
    if (!model_seen.empty() && !model_seen[hit.sample]) continue;
    vertices.push_back({mesh.stds_m[i], hit.distance});
  }
  if (vertices.empty()) return std::nullopt;

  SurfaceCalibration calibration;
  calibration.vertices = vertices.size();
  const Bin all = RootMeanSquares(vertices);
  calibration.std_m = all.std_m;
  calibration.error_m = all.error_m;
  for (std::size_t i = 0; i < calibration.share_within.size(); ++i) {
    const auto sigmas = static_cast<double>(i + 1);
    const auto within = std::count_if(
        vertices.begin(), vertices.end(),
        [sigmas](const Bin& vertex) { return vertex.error_m <= sigmas * vertex.std_m; });
    calibration.share_within[i] =
        static_cast<double>(within) / static_cast<double>(vertices.size());
  }
  std::sort(vertices.begin(), vertices.end(),
            [](const Bin& a, const Bin& b) { return a.std_m < b.std_m; });
  const std::size_t bins = std::min(kBins, vertices.size());
  for (std::size_t i = 0; i < bins; ++i) {
    const std::size_t begin = i * vertices.size() / bins;
    const std::size_t end = (i + 1) * vertices.size() / bins;
    calibration.bins.push_back(
        RootMeanSquares(std::span<const Bin>(vertices).subspan(begin, end - begin)));
  }
  return calibration;
}

}  // namespace disflow::apps
