// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "disflow/field/gp_workspace.h"

/// @file
/// Cost of the local GP: what one retrained cluster, one registration residual and one variance
/// cost.

namespace disflow {
namespace {

constexpr GpHyperparameters kHyper{0.06F, 0.25F};

/// Samples spread over a 3 cm patch of a sphere of 10 cm radius, as a cluster holds them.
std::vector<GpTrainingSample> SpherePatch(int count) {
  constexpr float kGoldenAngle_rad = 2.3999632F;
  constexpr float kRadius_m = 0.10F;
  std::vector<GpTrainingSample> samples;
  for (int i = 0; i < count; ++i) {
    const float share = (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
    const float rho = 0.15F * std::sqrt(share);
    const float phi = kGoldenAngle_rad * static_cast<float>(i);
    const Vec3 normal = Vec3(rho * std::cos(phi), rho * std::sin(phi), std::sqrt(1.0F - rho * rho));
    samples.push_back({kRadius_m * normal, normal, 1.5e-7F, 0.01F});
  }
  return samples;
}

const Vec3 kCenter_m(0.0F, 0.0F, 0.10F);

template <int N>
struct Trained {
  GpWorkspace<N> workspace;
  LocalGp<N> gp;
  bool ok = workspace.Train(SpherePatch(N), kCenter_m, Vec3::UnitZ(), kHyper, gp);
};

template <int N>
void BM_Train(benchmark::State& state) {
  const std::vector<GpTrainingSample> samples = SpherePatch(N);
  Trained<N> trained;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        trained.workspace.Train(samples, kCenter_m, Vec3::UnitZ(), kHyper, trained.gp));
    benchmark::ClobberMemory();
  }
}

template <int N>
void BM_Mean(benchmark::State& state) {
  const Trained<N> trained{};
  if (!trained.ok) state.SkipWithError("not trained");
  Vec3 x_m = kCenter_m;
  for (auto _ : state) {
    float distance_m;
    Vec3 gradient;
    trained.gp.Mean(x_m, distance_m, gradient);
    benchmark::DoNotOptimize(distance_m);
    benchmark::DoNotOptimize(gradient);
    x_m.x() = 1e-3F * (x_m.x() > 0.0F ? -1.0F : 1.0F);
  }
}

template <int N>
void BM_Covariance(benchmark::State& state) {
  Trained<N> trained;
  if (!trained.workspace.Factorise(trained.gp)) state.SkipWithError("not trained");
  const Vec3 x_m = kCenter_m + Vec3(1e-3F, 2e-3F, 3e-3F);
  for (auto _ : state) {
    benchmark::DoNotOptimize(trained.workspace.Covariance(trained.gp, x_m));
  }
}

BENCHMARK(BM_Train<12>);
BENCHMARK(BM_Train<16>);
BENCHMARK(BM_Mean<12>);
BENCHMARK(BM_Mean<16>);
BENCHMARK(BM_Covariance<16>);

}  // namespace
}  // namespace disflow
