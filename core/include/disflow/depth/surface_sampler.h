// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "disflow/config.h"
#include "disflow/depth/block_contrasts.h"
#include "disflow/depth/block_grid.h"
#include "disflow/depth/curved_window.h"
#include "disflow/depth/depth_reader.h"
#include "disflow/depth/inverse_depth_block.h"
#include "disflow/depth/sensor_noise.h"
#include "disflow/depth/surface_sample.h"
#include "disflow/depth/whole_windows.h"
#include "disflow/estimate.h"
#include "disflow/memory/fixed_vector.h"
#include "disflow/memory/stage_scratch.h"

namespace disflow {

/// The plane that was fitted to one block of pixels, camera frame.
struct BlockPlane {
  bool valid = false;
  Vec3 normal = Vec3::Zero();
  float offset_m = 0.0F;           ///< normal . x = offset on the plane.
  Vec3 position_m = Vec3::Zero();  ///< Where the block lies on it.
  float variance_m2 = 0.0F;        ///< Of that position along the normal.
  float normal_variance = 0.0F;
  float cos_incidence = 0.0F;  ///< Between viewing ray and normal, positive.
};

/// Turns the object's pixels into at most M surface samples with position, normal and variance.
///
/// Pixels are summed per small block; planes are fitted to windows of 3x3 blocks in inverse depth
/// (see inverse_depth_block.h). Where the whole window does not fit one plane, windows to one side
/// are tried, so that creases keep their normals; what fits nothing is a flying pixel or clutter
/// and is counted and dropped.
template <class Limits>
class SurfaceSampler {
 public:
  using Samples = FixedVector<SurfaceSample, Limits::kMaxSurfaceSamples>;

  /// @param interior Object pixels away from the outline.
  /// @param samples Must not change as long as SurfaceAt() is asked.
  template <class Mask>
  void Sample(const DepthReader& depth, const PinholeCamera& camera, const Mask& interior,
              const SamplerConfig& config, Samples& samples, Counters& counters) noexcept {
    samples.clear();
    samples_ = &samples;
    counters.pixels_out_of_range +=
        static_cast<std::uint32_t>(BuildGrid(depth, camera, interior, config));
    MeasureNoise(config);
    auto& windows = passes_.template Begin<WholeWindows>();
    for (int row = 0; row < grid_.rows(); ++row) {
      // Many windows at a time, for vector instructions.
      for (int first = 0; first < grid_.columns(); first += WholeWindows::kMost) {
        const int end = std::min(first + WholeWindows::kMost, grid_.columns());
        const int begin = grid_.FirstFilled(first, end, row);
        if (begin == end) continue;
        windows.Merge(grid_, begin, row, end - begin);
        for (int column = begin; column < end; ++column)
          FitBlock(camera, config, column, row, windows.at(column - begin), samples, counters);
      }
    }
  }

  /// The plane that was fitted to the block of a pixel; for edge points.
  [[nodiscard]] BlockPlane SurfaceAt(int u, int v) const noexcept {
    const std::uint16_t sample = grid_.SampleAt(u, v);
    if (sample == Grid::kNoSample) return {};
    const SurfaceSample& s = (*samples_)[sample];
    return {true,
            s.normal,
            s.normal.dot(s.position_m),
            s.position_m,
            s.fused_variance_m2,
            s.normal_variance,
            -s.normal.dot(s.position_m) / s.position_m.norm()};
  }

  [[nodiscard]] float noise_std() const noexcept { return noise_std_; }
  [[nodiscard]] int block_px() const noexcept { return grid_.block_px(); }

 private:
  using Grid = BlockGrid<Limits>;

  /// Blocks as small as the number of samples allows, but so wide that noise leaves the planes of
  /// their windows a normal: far objects have few pixels, and those err the most.
  /// @return How many pixels have no depth.
  template <class Mask>
  int BuildGrid(const DepthReader& depth, const PinholeCamera& camera, const Mask& interior,
                const SamplerConfig& config) noexcept {
    auto& sums = passes_.template Begin<typename Grid::Sums>();
    const int without_depth = grid_.Build(depth, interior, config, 0, sums);
    MeasureScales(config);
    const auto count = static_cast<float>(interior.count());
    const float most_px = std::sqrt(count / kFewestBlocks);
    const auto least_px = static_cast<int>(std::fmin(EdgeForNormals(camera, config), most_px));
    if (least_px > grid_.block_px()) {
      (void)grid_.Build(depth, interior, config, least_px, sums);
      MeasureScales(config);
    }
    least_pixels_ = LeastPixels(count, config);
    return without_depth;
  }

  /// How many pixels a block must have. Of a thing of few blocks, most of which reach over its
  /// outline, smaller parts count: what they tell less, their variance says.
  [[nodiscard]] float LeastPixels(float interior_count,
                                  const SamplerConfig& config) const noexcept {
    const auto area = static_cast<float>(grid_.block_px() * grid_.block_px());
    return config.min_fill * std::fmin(area, interior_count / kFewestBlocks);
  }

  /// Noise by blocks and by squares of 2x2 of them; where it is curvature that grows from one to
  /// the other, as on a bottle seen from its end, the squares say what the blocks say.
  void MeasureScales(const SamplerConfig& config) noexcept {
    // From squares of 2x2 to such of 3x3 noise that pixels share grows to 1.5, curvature of third
    // order to 1.5^4.
    constexpr float kMostOfNoise = 2.0F;
    const bool stated = config.inverse_depth_std_per_m > 0.0F;
    blocks_std_ = stated ? config.inverse_depth_std_per_m : noise_.template BlockNoise<1>(grid_);
    squares_std_ = means_std_ = blocks_std_;
    if (stated) return;
    const float squares_std = noise_.template BlockNoise<2>(grid_);
    const float growth = squares_std / blocks_std_;
    const float factor = CorrelationFactor(growth * growth);
    if (!(factor > 1.0F)) return;
    if (noise_.template BlockNoise<3>(grid_) > kMostOfNoise * squares_std) return;
    squares_std_ = squares_std;
    means_std_ = blocks_std_ * std::sqrt(factor);
  }

  /// Edge of blocks, in pixels, at which a window that faces the camera has its normal to
  /// SamplerConfig::normal_std_rad. The slope of a plane through W x W pixels is known to
  /// sqrt(12) / W^2 times their noise; and W is three blocks.
  [[nodiscard]] float EdgeForNormals(const PinholeCamera& camera,
                                     const SamplerConfig& config) const noexcept {
    constexpr float kBlocks = 3.0F;
    constexpr float kRootOf12 = 3.4641016F;
    const float w = grid_.MeanInverseDepth();
    if (!(w > 0.0F)) return 0.0F;
    // Of squares of blocks: blocks may be smaller than what errs alike, which hides the noise.
    const float tilt_px2 = kRootOf12 * squares_std_ * camera.fx_px / w;
    return std::round(std::sqrt(tilt_px2 / config.normal_std_rad) / kBlocks);
  }

  void MeasureNoise(const SamplerConfig& config) noexcept {
    noise_std_ =
        config.inverse_depth_std_per_m > 0.0F
            ? config.inverse_depth_std_per_m
            : std::max({noise_.PixelNoise(grid_), blocks_std_, config.min_inverse_depth_std_per_m});
    mean_noise_factor_ = std::fmax(1.0F, means_std_ / noise_std_);
  }

  /// @param whole The block's whole window.
  void FitBlock(const PinholeCamera& camera, const SamplerConfig& config, int column, int row,
                const WholeWindow& whole, Samples& samples, Counters& counters) noexcept {
    const PixelMoments& own = grid_.block(column, row);
    if (own.n == 0.0F) return;
    if (own.n < least_pixels_) {
      ++counters.blocks_sparse;
      return;
    }
    float bend = 0.0F;
    const InverseDepthPlane plane = BestPlane(config, column, row, whole, own, bend);
    if (!plane.valid) {
      ++counters.blocks_flying;
      return;
    }
    SurfaceSample sample;
    if (!MakeSample(camera, config, column, row, own, plane, bend, sample)) {
      ++counters.blocks_grazing;
      return;
    }
    if (!samples.push_back(sample)) {
      ++counters.samples_dropped;
      return;
    }
    grid_.SetSample(column, row, samples.size() - 1);
  }

  /// @param bend Of the surface from the plane at the block [1/m].
  [[nodiscard]] InverseDepthPlane BestPlane(const SamplerConfig& config, int column, int row,
                                            const WholeWindow& whole, const PixelMoments& own,
                                            float& bend) const noexcept {
    const float limit_std = config.max_residual_sigmas * noise_std_;
    const float limit = limit_std * limit_std;
    // What the pixels of a block have in common moves its mean and leaves no residual.
    const float means_std = mean_noise_factor_ * noise_std_;
    const float means_variance = means_std * means_std;
    const float own_u = own.u / own.n;
    const float own_v = own.v / own.n;
    const float own_w = own.w_reference + own.w / own.n;
    // Curved surface bends away from any plane, which a good sensor sees: it must not be taken for
    // clutter.
    const float allowed_bend = config.max_bend_ratio * own_w;
    InverseDepthPlane best;
    for (std::size_t i = 0; i < kBlockWindows.size(); ++i) {
      InverseDepthPlane plane = InverseDepthPlane::Fit(
          i == 0 ? whole.sums : grid_.MergeWindow(column, row, kBlockWindows[i]));
      if (!plane.valid) continue;
      if (i == 0) {
        const CurvedWindow curved = CurvedWindow::Fit(
            whole.bends, plane, static_cast<float>(grid_.block_px() * grid_.block_px()),
            means_variance);
        if (curved.valid &&
            curved.residual_variance <= limit + kRipple * allowed_bend * allowed_bend) {
          bend = curved.bend;
          plane.residual_variance = curved.residual_variance;
          return plane;  // one smooth piece of surface: no need to look at parts
        }
      }
      if (plane.residual_variance > limit + allowed_bend * allowed_bend) continue;
      const float deviation = own_w - plane.At(own_u, own_v);
      const float expected = means_variance * (1.0F / own.n + plane.Leverage(own_u, own_v));
      if (deviation * deviation > 9.0F * expected + allowed_bend * allowed_bend) continue;
      if (!best.valid || plane.residual_variance < best.residual_variance) {
        best = plane;
        bend = CurvedWindow::Shrunk(deviation, expected);
      }
      if (i == 0 && plane.residual_variance <= limit) break;
    }
    return best;
  }

  [[nodiscard]] bool MakeSample(const PinholeCamera& camera, const SamplerConfig& config,
                                int column, int row, const PixelMoments& own,
                                const InverseDepthPlane& plane, float bend,
                                SurfaceSample& sample) const noexcept {
    const float du = own.u / own.n;
    const float dv = own.v / own.n;
    const float u = grid_.CenterU(column) + du;
    const float v = grid_.CenterV(row) + dv;
    const float w = plane.At(du, dv) + bend;
    if (!(w > 0.0F)) return false;
    // w = g . ray on the plane, so g is normal to it and 1 / |g| is its distance from the camera.
    const Vec3 ray = camera.Ray(u, v);
    const float gx = plane.slope_u * camera.fx_px;
    const float gy = plane.slope_v * camera.fy_px;
    const Vec3 g(gx, gy, w - gx * ray.x() - gy * ray.y());
    const float g_norm = g.norm();
    const float ray_norm = ray.norm();
    const float depth_m = 1.0F / w;
    sample.normal = -g / g_norm;
    sample.position_m = depth_m * ray;
    const float cos_incidence = w / (g_norm * ray_norm);
    if (cos_incidence < config.min_cos_incidence) return false;
    sample.reach_m = depth_m * std::numbers::sqrt2_v<float> * 0.5F *
                     static_cast<float>(grid_.block_px()) / camera.fx_px;
    // dz = z^2 dw along the ray; projected onto the normal.
    const float effective_std =
        std::sqrt(std::max(noise_std_ * noise_std_, plane.residual_variance));
    const float along_normal = depth_m * depth_m * ray_norm * cos_incidence * effective_std;
    const float floor = config.sample_floor_m * config.sample_floor_m;
    sample.variance_m2 = along_normal * along_normal / own.n + floor;
    sample.fused_variance_m2 = along_normal * along_normal * plane.Leverage(du, dv) + floor;
    // Slopes tilt the plane by f ds / |g|.
    const float tilt_u = camera.fx_px / g_norm;
    const float tilt_v = camera.fy_px / g_norm;
    sample.normal_variance =
        0.5F * effective_std * effective_std *
        (plane.inverse_uu * tilt_u * tilt_u + plane.inverse_vv * tilt_v * tilt_v);
    return true;
  }

  /// Fewer leave less to register than what better normals or fuller blocks bring.
  static constexpr float kFewestBlocks = 150.0F;
  static constexpr float kRipple =
      0.05F;  ///< Third order allowed, as share of the second, squared.

  Grid grid_;
  /// Building the grid and fitting to it follow each other.
  StageScratch<typename Grid::Sums, WholeWindows> passes_;
  SensorNoise noise_;
  const Samples* samples_ = nullptr;  ///< Of the last frame, for SurfaceAt().
  float least_pixels_ = 0.0F;         ///< Of a block that counts.
  float noise_std_ = 0.0F;
  float blocks_std_ = 0.0F;   ///< By how far the means of blocks scatter; 0 if nothing is known.
  float squares_std_ = 0.0F;  ///< The same of squares of 2x2 blocks.
  float means_std_ = 0.0F;    ///< As blocks_std_, with what neighbouring blocks share.
  /// How much larger the noise per pixel is that explains how far the means of blocks are off.
  float mean_noise_factor_ = 1.0F;
};

}  // namespace disflow
