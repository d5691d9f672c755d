// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"

namespace disflow::host {

/// How far a simulated camera's images are from the truth, measured on an object at rest. Disparity
/// errors are those of 55 mm baseline; errors of 1 px and more are gross ones and counted apart.
struct SensorStatistics {
  double std_px = 0.0;         ///< Root mean square.
  double facing_std_px = 0.0;  ///< Of surface within 30 degrees of facing the camera.
  double mean_px = 0.0;
  double depth_std_m = 0.0;
  double depth_mean_m = 0.0;
  double gross_share = 0.0;
  double hole_share = 0.0;
  double grazing_hole_share = 0.0;  ///< Of surface seen at more than 70 degrees.
  double correlation_1px = 0.0;
  double correlation_2px = 0.0;
  double correlation_4px = 0.0;
  double correlation_8px = 0.0;
  double correlation_next_frame = 0.0;  ///< At the same pixel.
  double fattened_2px = 0.0;  ///< Share of the rows that show the object outside its right outline.
  double fattened_4px = 0.0;
};

/// Adds up what SensorStatistics is made from.
class SensorMeasurement {
 public:
  void Add(SimulationOptions options, int frames) {
    options.motion = MotionKind::kStatic;
    options.frames = frames;
    SimulationOptions exact = options;
    exact.noise = NoiseKind::kClean;
    width_ = options.width_px;
    height_ = options.height_px;
    fx_px_ = static_cast<double>(SimulatedCamera(options).fx_px);
    Simulation clean(exact, MakeObjectMesh(options.object));
    Simulation noisy(options, MakeObjectMesh(options.object));
    true_m_ = DepthOf(clean, 0);
    mask_.assign(clean.gt_mask().data, clean.gt_mask().data + true_m_.size());
    FindInside();
    std::vector<float> last;
    for (int frame = 0; frame < frames; ++frame) {
      const std::vector<float> measured_m = DepthOf(noisy, frame);
      std::vector<float> error_px = Errors(measured_m);
      AddPixels(measured_m, error_px);
      for (const int lag : {1, 2, 4, 8}) AddLag(error_px, lag);
      AddOutlines(measured_m);
      for (std::size_t i = 0; i < last.size(); ++i) next_.Add(last[i], error_px[i]);
      last = std::move(error_px);
    }
  }

  [[nodiscard]] SensorStatistics Result() const {
    SensorStatistics result;
    result.std_px = Rms(all_);
    result.facing_std_px = Rms(facing_);
    result.mean_px = all_.sum / all_.count;
    result.depth_mean_m = depth_.sum / depth_.count;
    result.depth_std_m =
        std::sqrt(depth_.squares / depth_.count - result.depth_mean_m * result.depth_mean_m);
    result.gross_share = gross_ / (gross_ + all_.count);
    result.hole_share = holes_ / inside_count_;
    result.grazing_hole_share = grazing_holes_ / std::max(1.0, grazing_count_);
    result.correlation_1px = lags_[1].Correlation();
    result.correlation_2px = lags_[2].Correlation();
    result.correlation_4px = lags_[4].Correlation();
    result.correlation_8px = lags_[8].Correlation();
    result.correlation_next_frame = next_.Correlation();
    result.fattened_2px = fattened_[2] / rows_;
    result.fattened_4px = fattened_[4] / rows_;
    return result;
  }

 private:
  static constexpr float kNone = 1e9F;

  struct Moments {
    double sum = 0.0, squares = 0.0, count = 0.0;
    void Add(double value) {
      sum += value;
      squares += value * value;
      count += 1.0;
    }
  };
  struct Pairs {
    double a = 0.0, b = 0.0, ab = 0.0, aa = 0.0, bb = 0.0, count = 0.0;
    void Add(float first, float second) {
      if (first == kNone || second == kNone) return;
      const auto x = static_cast<double>(first);
      const auto y = static_cast<double>(second);
      a += x, b += y, ab += x * y, aa += x * x, bb += y * y, count += 1.0;
    }
    [[nodiscard]] double Correlation() const {
      const double covariance = ab / count - a * b / (count * count);
      return covariance / std::sqrt((aa / count - a * a / (count * count)) *
                                    (bb / count - b * b / (count * count)));
    }
  };
  static double Rms(const Moments& m) { return std::sqrt(m.squares / std::max(1.0, m.count)); }

  static std::vector<float> DepthOf(Simulation& simulation, int frame) {
    DepthFrame image;
    simulation.Render(frame, image);
    std::vector<float> depth_m(static_cast<std::size_t>(image.depth.width_px) *
                               static_cast<std::size_t>(image.depth.height_px));
    std::memcpy(depth_m.data(), image.depth.data, depth_m.size() * sizeof(float));
    return depth_m;
  }
  [[nodiscard]] std::size_t Index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(u);
  }
  [[nodiscard]] double Disparity(float depth_m) const {
    return fx_px_ * 0.055 / static_cast<double>(depth_m);
  }

  /// Pixels 5 px (of 640) and more from the outline, and at which angle they are seen.
  void FindInside() {
    const int reach = std::max(2, 5 * width_ / 640);
    inside_.assign(mask_.size(), false);
    cos_.assign(mask_.size(), 0.0);
    for (int v = reach; v < height_ - reach; ++v) {
      for (int u = reach; u < width_ - reach; ++u) {
        bool inside = true;
        for (int dv = -reach; dv <= reach && inside; ++dv) {
          for (int du = -reach; du <= reach && inside; ++du)
            inside = mask_[Index(u + du, v + dv)] != 0;
        }
        inside_[Index(u, v)] = inside;
        if (inside) cos_[Index(u, v)] = CosIncidence(u, v);
      }
    }
  }
  [[nodiscard]] double CosIncidence(int u, int v) const {
    const auto inverse = [this](int a, int b) {
      return 1.0 / static_cast<double>(true_m_[Index(a, b)]);
    };
    const double x = (u - 0.5 * width_) / fx_px_;
    const double y = (v - 0.5 * height_) / fx_px_;
    const double w = inverse(u, v);
    const double nx = fx_px_ * 0.5 * (inverse(u + 1, v) - inverse(u - 1, v));
    const double ny = fx_px_ * 0.5 * (inverse(u, v + 1) - inverse(u, v - 1));
    const double nz = w - nx * x - ny * y;
    return w / std::sqrt((nx * nx + ny * ny + nz * nz) * (x * x + y * y + 1.0));
  }

  [[nodiscard]] std::vector<float> Errors(const std::vector<float>& measured_m) const {
    std::vector<float> error_px(measured_m.size(), kNone);
    for (std::size_t i = 0; i < measured_m.size(); ++i) {
      if (!inside_[i] || measured_m[i] == 0.0F) continue;
      const double error = Disparity(measured_m[i]) - Disparity(true_m_[i]);
      if (std::abs(error) < 1.0) error_px[i] = static_cast<float>(error);
    }
    return error_px;
  }

  void AddPixels(const std::vector<float>& measured_m, const std::vector<float>& error_px) {
    for (std::size_t i = 0; i < measured_m.size(); ++i) {
      if (!inside_[i]) continue;
      constexpr double kGrazing = 0.34;
      constexpr double kFacing = 0.866;
      const bool hole = measured_m[i] == 0.0F;
      inside_count_ += 1.0;
      holes_ += hole ? 1.0 : 0.0;
      if (cos_[i] < kGrazing) {
        grazing_count_ += 1.0;
        grazing_holes_ += hole ? 1.0 : 0.0;
      }
      if (hole) continue;
      if (error_px[i] == kNone) {
        gross_ += 1.0;
        continue;
      }
      const auto error = static_cast<double>(error_px[i]);
      all_.Add(error);
      if (cos_[i] > kFacing) facing_.Add(error);
      depth_.Add(static_cast<double>(measured_m[i]) - static_cast<double>(true_m_[i]));
    }
  }

  void AddLag(const std::vector<float>& error_px, int lag) {
    for (int v = 0; v < height_; ++v) {
      for (int u = 0; u + lag < width_; ++u)
        lags_[static_cast<std::size_t>(lag)].Add(error_px[Index(u, v)],
                                                 error_px[Index(u + lag, v)]);
    }
  }

  void AddOutlines(const std::vector<float>& measured_m) {
    for (int v = 0; v < height_; ++v) {
      int right = -1;
      for (int u = 0; u + 12 < width_; ++u) {
        if (mask_[Index(u, v)] != 0) right = u;
      }
      if (right < 0) continue;
      const double near_px = Disparity(true_m_[Index(right, v)]);
      rows_ += 1.0;
      for (const int outside : {2, 4}) {
        const std::size_t there = Index(right + outside, v);
        const double far_px = Disparity(true_m_[there]);
        if (measured_m[there] == 0.0F) continue;
        if (Disparity(measured_m[there]) > 0.5 * (near_px + far_px))
          fattened_[static_cast<std::size_t>(outside)] += 1.0;
      }
    }
  }

  int width_ = 0;
  int height_ = 0;
  double fx_px_ = 0.0;
  std::vector<float> true_m_;
  std::vector<std::uint8_t> mask_;
  std::vector<bool> inside_;
  std::vector<double> cos_;
  Moments all_;
  Moments facing_;
  Moments depth_;
  double gross_ = 0.0;
  double holes_ = 0.0;
  double inside_count_ = 0.0;
  double grazing_holes_ = 0.0;
  double grazing_count_ = 0.0;
  double rows_ = 0.0;
  double fattened_[5] = {};
  Pairs lags_[9];
  Pairs next_;
};

}  // namespace disflow::host
