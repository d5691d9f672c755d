// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nearest_surface.h"

namespace disflow::apps {
namespace {

/// Sums over the samples of one surface, measured to the other.
class OneWay {
 public:
  void Add(const SurfacePoint& from, const NearestSurface::Hit& to) {
    ++count_;
    distance_sum_ += to.distance;
    distance_max_ = std::max(distance_max_, to.distance);
    for (std::size_t i = 0; i < within_.size(); ++i) {
      if (to.distance <= kFScoreDistances_m[i]) within_[i] += 1.0;
    }
    if (from.normal.isZero() || to.point.normal.isZero()) return;
    ++normal_count_;
    normal_sum_ += std::acos(std::clamp(from.normal.dot(to.point.normal), -1.0, 1.0));
  }

  // 0 / 0 gives the NaN that stands for "nothing to compare".
  [[nodiscard]] double mean() const { return distance_sum_ / count_; }
  [[nodiscard]] double max() const {
    return count_ > 0.0 ? distance_max_ : std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] double share_within(std::size_t i) const { return within_[i] / count_; }
  [[nodiscard]] double mean_normal() const { return normal_sum_ / normal_count_; }

 private:
  double count_ = 0.0;
  double distance_sum_ = 0.0;
  double distance_max_ = 0.0;
  std::array<double, kFScoreDistances_m.size()> within_{};
  double normal_count_ = 0.0;
  double normal_sum_ = 0.0;
};

/// Both directions of a comparison.
struct BothWays {
  OneWay mesh_to_model;
  OneWay model_to_mesh;

  [[nodiscard]] MeshMetrics Metrics() const {
    MeshMetrics m;
    m.accuracy_m = mesh_to_model.mean();
    m.completeness_m = model_to_mesh.mean();
    m.chamfer_m = 0.5 * (m.accuracy_m + m.completeness_m);
    m.hausdorff_m = std::fmax(mesh_to_model.max(), model_to_mesh.max());
    for (std::size_t i = 0; i < m.f_score.size(); ++i) {
      const double precision = mesh_to_model.share_within(i);
      const double recall = model_to_mesh.share_within(i);
      const double sum = precision + recall;
      m.f_score[i] = sum == 0.0 ? 0.0 : 2.0 * precision * recall / sum;
    }
    m.mesh_to_model_normal_rad = mesh_to_model.mean_normal();
    m.model_to_mesh_normal_rad = model_to_mesh.mean_normal();
    return m;
  }
};

}  // namespace

MeshComparison CompareMeshes(const Surface& mesh, const Surface& model,
                             const std::vector<SurfacePoint>& model_samples,
                             const std::vector<bool>& model_seen) {
  const NearestSurface nearest_on_mesh(mesh, SampleSurface(mesh, kMeshSamples));
  const NearestSurface nearest_on_model(model, model_samples);
  const auto is_seen = [&](std::size_t i) { return !model_seen.empty() && model_seen[i]; };
  BothWays whole;
  BothWays seen;
  for (const SurfacePoint& point : nearest_on_mesh.samples()) {
    const NearestSurface::Hit hit = nearest_on_model.Find(point.position);
    whole.mesh_to_model.Add(point, hit);
    if (is_seen(hit.sample)) seen.mesh_to_model.Add(point, hit);
  }
  for (std::size_t i = 0; i < model_samples.size(); ++i) {
    const NearestSurface::Hit hit = nearest_on_mesh.Find(model_samples[i].position);
    whole.model_to_mesh.Add(model_samples[i], hit);
    if (is_seen(i)) seen.model_to_mesh.Add(model_samples[i], hit);
  }
  const auto seen_count = std::count(model_seen.begin(), model_seen.end(), true);
  return {whole.Metrics(), seen.Metrics(),
          static_cast<double>(seen_count) / static_cast<double>(model_seen.size())};
}

}  // namespace disflow::apps
