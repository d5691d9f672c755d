// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/image_noise.h"

#include <algorithm>
#include <cmath>

namespace disflow::host {
namespace {

/// Inverse of the normal distribution function by bisection: slow and exact, used once.
float NormalQuantile(double probability) {
  double low = -8.0;
  double high = 8.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < probability ? low : high) = middle;
  }
  return static_cast<float>(0.5 * (low + high));
}

/// Gaussian weights whose squares sum up to 1: independent numbers keep their variance.
std::vector<float> Kernel(double std_px) {
  const int reach = std::max(1, static_cast<int>(std::ceil(3.5 * std_px)));
  std::vector<double> weights;
  double squares = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(std_px > 0.0 ? std::exp(-0.5 * (i / std_px) * (i / std_px))
                                   : static_cast<double>(i == 0));
    squares += weights.back() * weights.back();
  }
  std::vector<float> kernel;
  kernel.reserve(weights.size());
  for (const double weight : weights)
    kernel.push_back(static_cast<float>(weight / std::sqrt(squares)));
  return kernel;
}

/// Convolves one line, a closed ring of `count` numbers.
void ConvolveRing(const std::vector<float>& kernel, std::vector<float>& ring, float* out, int count,
                  int stride) {
  const int taps = static_cast<int>(kernel.size());
  // The ring's start is repeated at its end, so that the inner loop needs no modulo.
  for (int i = 0; i < taps; ++i)
    ring[static_cast<std::size_t>(count + i)] = ring[static_cast<std::size_t>(i % count)];
  for (int i = 0; i < count; ++i) {
    float sum = 0.0F;
    for (int k = 0; k < taps; ++k)
      sum += kernel[static_cast<std::size_t>(k)] * ring[static_cast<std::size_t>(i + k)];
    out[static_cast<std::ptrdiff_t>(i) * stride] = sum;
  }
}

}  // namespace

NormalTable::NormalTable() : quantiles_(std::size_t{1} << kBits) {
  const auto count = static_cast<double>(quantiles_.size());
  for (std::size_t i = 0; i < quantiles_.size(); ++i)
    quantiles_[i] = NormalQuantile((static_cast<double>(i) + 0.5) / count);
}

void DrawSmoothNoise(const NormalTable& normal, RandomNumbers& random, double kernel_std_px,
                     int width_px, int height_px, std::vector<float>& noise) {
  const auto width = static_cast<std::size_t>(width_px);
  const auto height = static_cast<std::size_t>(height_px);
  const std::vector<float> kernel = Kernel(kernel_std_px);
  noise.resize(width * height);
  std::vector<float> ring(std::max(width, height) + kernel.size());
  BitSource bits(random);
  for (std::size_t v = 0; v < height; ++v) {
    for (std::size_t u = 0; u < width; ++u) ring[u] = normal.Draw(bits);
    ConvolveRing(kernel, ring, noise.data() + v * width, width_px, 1);
  }
  for (std::size_t u = 0; u < width; ++u) {
    for (std::size_t v = 0; v < height; ++v) ring[v] = noise[v * width + u];
    ConvolveRing(kernel, ring, noise.data() + u, height_px, width_px);
  }
}

ImageNoise::ImageNoise(const ImageNoiseModel& model, int width_px, int height_px,
                       std::uint64_t seed)
    : model_(model),
      width_(width_px),
      height_(height_px),
      seed_(seed),
      kept_share_(static_cast<float>(std::sqrt(model.rest_correlation))),
      fresh_share_(static_cast<float>(std::sqrt(1.0 - model.rest_correlation))) {
  constexpr std::uint64_t kStream = 10;
  RandomNumbers random(seed, kStream);
  for (Shift& shift : shifts_) {
    shift = {static_cast<int>(random.Uniform(0.0, width_px)),
             static_cast<int>(random.Uniform(0.0, height_px))};
  }
  DrawSmoothNoise(normal_, random, model_.kernel_std_px, width_, height_, kept_);
}

void ImageNoise::StartFrame(int frame) {
  if (fresh_share_ == 0.0F) return;
  constexpr std::uint64_t kFirstStream = 2'000'000;  // clear of all others
  RandomNumbers random(seed_, kFirstStream + static_cast<std::uint64_t>(frame));
  DrawSmoothNoise(normal_, random, model_.kernel_std_px, width_, height_, fresh_);
}

float ImageNoise::Shifted(const std::vector<float>& noise, int u, int v,
                          std::uint32_t shift) const {
  const Shift& by = shifts_[shift % kShifts];
  int column = u + by.u;
  int row = v + by.v;
  if (column >= width_) column -= width_;
  if (row >= height_) row -= height_;
  return noise[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(column)];
}

float ImageNoise::At(int u, int v, float disparity_px, std::uint32_t set) const {
  constexpr std::uint32_t kShiftsPerSet = 101;
  const float layers = std::max(0.0F, disparity_px / static_cast<float>(model_.layer_px));
  const auto layer = static_cast<std::uint32_t>(layers);
  const float next = layers - static_cast<float>(layer);
  const float here = 1.0F - next;
  const std::uint32_t first = set * kShiftsPerSet + layer;
  // The weights' squares have to sum up to 1 for the variance to stay what it is.
  const float kept = (here * Shifted(kept_, u, v, first) + next * Shifted(kept_, u, v, first + 1)) /
                     std::sqrt(here * here + next * next);
  if (fresh_share_ == 0.0F) return kept;
  return kept_share_ * kept + fresh_share_ * Shifted(fresh_, u, v, set * kShiftsPerSet);
}

}  // namespace disflow::host
