// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "disflow/config.h"
#include "disflow/depth/block_contrasts.h"
#include "disflow/depth/curved_window.h"
#include "disflow/depth/depth_reader.h"
#include "disflow/depth/inverse_depth_block.h"
#include "disflow/depth/pixel_mask.h"
#include "disflow/depth/surface_sample.h"
#include "disflow/estimate.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// The plane that was fitted to one block of pixels, camera frame.
struct BlockPlane {
  bool valid = false;
  Vec3 normal = Vec3::Zero();
  float offset_m = 0.0F;  ///< normal . x = offset on the plane.
  float normal_variance = 0.0F;
  float cos_incidence = 0.0F;
};

/// A rectangle of blocks around one of them.
struct BlockWindow {
  int column_min, column_max, row_min, row_max;  // offsets in blocks, both included
};
/// The whole neighbourhood first, then the halves and the quarters that contain the block itself.
inline constexpr std::array<BlockWindow, 9> kBlockWindows{{{-1, 1, -1, 1},
                                                           {-1, 0, -1, 1},
                                                           {0, 1, -1, 1},
                                                           {-1, 1, -1, 0},
                                                           {-1, 1, 0, 1},
                                                           {-1, 0, -1, 0},
                                                           {0, 1, -1, 0},
                                                           {-1, 0, 0, 1},
                                                           {0, 1, 0, 1}}};

/// Turns the object's pixels into at most M surface samples with position, normal and variance.
///
/// Pixels are summed per small block; planes are fitted to windows of 3x3 blocks in inverse depth
/// (see inverse_depth_block.h). Where the whole window does not fit one plane, windows to one side
/// are tried, so that creases keep their normals; what fits nothing is a flying pixel or clutter
/// and is counted and dropped.
///
/// The grid of blocks covers the object's bounding box; sums are kept only for blocks that hold
/// pixels.
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
    ChooseBlockSize(interior, config);
    int without_depth = 0;
    while (!LayOutGrid(interior.box()) || !SumBlocks(depth, interior, without_depth)) ++block_px_;
    counters.pixels_out_of_range += static_cast<std::uint32_t>(without_depth);
    noise_std_ = config.inverse_depth_std_per_m > 0.0F
                     ? config.inverse_depth_std_per_m
                     : std::max({PixelNoise(), BlockNoise(), config.min_inverse_depth_std_per_m});
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column)
        FitBlock(camera, config, column, row, samples, counters);
    }
  }

  /// The plane that was fitted to the block of a pixel; for edge points.
  [[nodiscard]] BlockPlane SurfaceAt(int u, int v) const noexcept {
    const int column = (u - origin_u_) / block_px_;
    const int row = (v - origin_v_) / block_px_;
    if (u < origin_u_ || v < origin_v_ || column >= columns_ || row >= rows_) return {};
    const std::uint16_t sample = sample_of_[grid_[Index(column, row)]];
    if (sample == kNoSample) return {};
    const SurfaceSample& s = (*samples_)[sample];
    return {true, s.normal, s.normal.dot(s.position_m), s.normal_variance, s.cos_incidence};
  }

  [[nodiscard]] float noise_std() const noexcept { return noise_std_; }
  [[nodiscard]] int block_px() const noexcept { return block_px_; }

 private:
  [[nodiscard]] std::size_t Index(int column, int row) const noexcept {
    return static_cast<std::size_t>(row * columns_ + column);
  }
  [[nodiscard]] const PixelMoments& block(int column, int row) const noexcept {
    return moments_[grid_[Index(column, row)]];
  }

  /// The smallest blocks for which the samples are not too many.
  template <class Mask>
  void ChooseBlockSize(const Mask& interior, const SamplerConfig& config) noexcept {
    const float pixels_per_block =
        static_cast<float>(interior.count()) / static_cast<float>(config.target_blocks);
    block_px_ = std::clamp(static_cast<int>(std::lround(std::sqrt(pixels_per_block))),
                           config.min_block_px, config.max_block_px);
    // Partly covered blocks yield samples too: leave them some room.
    while (1.2F * static_cast<float>(interior.count()) >
           static_cast<float>(Limits::kMaxSurfaceSamples * block_px_ * block_px_))
      ++block_px_;
  }

  /// @return false if the grid has too many blocks.
  [[nodiscard]] bool LayOutGrid(const PixelBox& box) noexcept {
    columns_ = (box.width() + block_px_ - 1) / block_px_;
    rows_ = (box.height() + block_px_ - 1) / block_px_;
    if (columns_ * rows_ > Limits::kMaxBlocks) return false;
    origin_u_ = box.u_min;
    origin_v_ = box.v_min;
    std::fill_n(grid_.begin(), columns_ * rows_, kEmptyBlock);
    moments_[kEmptyBlock] = PixelMoments{};
    sample_of_[kEmptyBlock] = kNoSample;
    filled_ = 1;
    return true;
  }

  /// @return false if too many blocks hold pixels.
  template <class Mask>
  [[nodiscard]] bool SumBlocks(const DepthReader& depth, const Mask& interior,
                               int& without_depth) noexcept {
    without_depth = 0;
    bool fits = true;
    const float half = 0.5F * static_cast<float>(block_px_ - 1);
    const PixelBox& box = interior.box();
    for (int v = box.v_min; v < box.v_max && fits; ++v) {
      const int row = (v - origin_v_) / block_px_;
      const float dv = static_cast<float>(v - origin_v_ - row * block_px_) - half;
      int column = 0;
      int u_begin = origin_u_;
      interior.ForEachInRow(v, [&](int u) {
        const float depth_m = depth.At(u, v);
        if (depth_m <= 0.0F) {
          ++without_depth;
          return;
        }
        for (; u >= u_begin + block_px_; u_begin += block_px_) ++column;
        PixelMoments* moments = FillBlock(Index(column, row));
        if (moments == nullptr) {
          fits = false;
        } else {
          moments->Add(static_cast<float>(u - u_begin) - half, dv, 1.0F / depth_m);
        }
      });
    }
    return fits;
  }

  /// The sums of a block that holds pixels; null if there is no room for more of them.
  [[nodiscard]] PixelMoments* FillBlock(std::size_t place) noexcept {
    std::uint16_t& index = grid_[place];
    if (index == kEmptyBlock) {
      if (filled_ == kMaxFilledBlocks) return nullptr;
      index = static_cast<std::uint16_t>(filled_++);
      moments_[index] = PixelMoments{};
      sample_of_[index] = kNoSample;
    }
    return &moments_[index];
  }

  [[nodiscard]] PixelMoments MergeWindow(int column, int row,
                                         const BlockWindow& window) const noexcept {
    PixelMoments sum = block(column, row);
    const auto step = static_cast<float>(block_px_);
    for (int r = std::max(row + window.row_min, 0); r <= std::min(row + window.row_max, rows_ - 1);
         ++r) {
      for (int c = std::max(column + window.column_min, 0);
           c <= std::min(column + window.column_max, columns_ - 1); ++c) {
        if (c == column && r == row) continue;
        sum.Merge(block(c, r), step * static_cast<float>(c - column),
                  step * static_cast<float>(r - row));
      }
    }
    return sum;
  }

  /// Sensor noise of 1/z per pixel: the median residual of small windows, which curvature and
  /// creases hardly disturb.
  [[nodiscard]] float PixelNoise() noexcept {
    // A block of fewer than 4x4 pixels leaves too few degrees of freedom by itself.
    const BlockWindow window = block_px_ >= 4 ? BlockWindow{0, 0, 0, 0} : BlockWindow{0, 1, 0, 1};
    int count = 0;
    const int stride = std::max(1, columns_ * rows_ / kNoiseBlocks);
    for (int i = 0; i < columns_ * rows_ && count < kNoiseBlocks; i += stride) {
      const int column = i % columns_;
      const int row = i / columns_;
      const float full = static_cast<float>(block_px_ * block_px_ * (window.row_max + 1) *
                                            (window.column_max + 1));
      const PixelMoments sum = MergeWindow(column, row, window);
      if (sum.n < 0.8F * full) continue;
      const InverseDepthPlane plane = InverseDepthPlane::Fit(sum);
      if (plane.valid) residuals_[static_cast<std::size_t>(count++)] = plane.residual_variance;
    }
    return std::sqrt(MedianResidual(count));
  }

  /// The noise per pixel that explains how far the means of blocks scatter: larger than that of
  /// single pixels where neighbouring pixels err alike, as with any real sensor.
  [[nodiscard]] float BlockNoise() noexcept {
    constexpr int kMinWindows = 8;
    constexpr float kFull = 0.9F;
    const auto pixels = static_cast<float>(block_px_ * block_px_);
    int count = 0;
    const int stride = std::max(1, columns_ * rows_ / kNoiseBlocks);
    for (int i = 0; i < columns_ * rows_ && count < kNoiseBlocks; i += stride) {
      const int column = i % columns_;
      const int row = i / columns_;
      if (column < 1 || row < 1 || column + 1 >= columns_ || row + 1 >= rows_) continue;
      BlockMeans means;
      float fewest = pixels;
      for (int k = 0; k < 9; ++k) {
        const PixelMoments& moments = block(column + k % 3 - 1, row + k / 3 - 1);
        fewest = std::min(fewest, moments.n);
        means[static_cast<std::size_t>(k)] =
            moments.w_reference + moments.w / std::max(moments.n, 1.0F);
      }
      if (fewest < kFull * pixels) continue;
      residuals_[static_cast<std::size_t>(count++)] = ThirdOrderVariance(means);
    }
    return count < kMinWindows ? 0.0F
                               : std::sqrt(MedianResidual(count) / kThirdOrderMedian * pixels);
  }

  /// Of the first ones; 0 if there are none.
  [[nodiscard]] float MedianResidual(int count) noexcept {
    if (count == 0) return 0.0F;
    const auto middle = residuals_.begin() + count / 2;
    std::nth_element(residuals_.begin(), middle, residuals_.begin() + count);
    return *middle;
  }

  void FitBlock(const PinholeCamera& camera, const SamplerConfig& config, int column, int row,
                Samples& samples, Counters& counters) noexcept {
    const PixelMoments& own = block(column, row);
    if (own.n == 0.0F) return;
    const auto area = static_cast<float>(block_px_ * block_px_);
    if (own.n < config.min_fill * area) {
      ++counters.blocks_sparse;
      return;
    }
    float bend = 0.0F;
    const InverseDepthPlane plane = BestPlane(config, column, row, own, bend);
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
    sample_of_[grid_[Index(column, row)]] = static_cast<std::uint16_t>(samples.size() - 1);
  }

  /// @param bend Of the surface from the plane at the block [1/m].
  [[nodiscard]] InverseDepthPlane BestPlane(const SamplerConfig& config, int column, int row,
                                            const PixelMoments& own, float& bend) const noexcept {
    const float noise_variance = noise_std_ * noise_std_;
    const float limit = config.max_residual_sigmas * config.max_residual_sigmas * noise_variance;
    const float own_u = own.u / own.n;
    const float own_v = own.v / own.n;
    const float own_w = own.w_reference + own.w / own.n;
    // Curved surface bends away from any plane, which a good sensor sees: it must not be taken for
    // clutter.
    const float allowed_bend = config.max_bend_ratio * own_w;
    InverseDepthPlane best;
    for (std::size_t i = 0; i < kBlockWindows.size(); ++i) {
      InverseDepthPlane plane = InverseDepthPlane::Fit(MergeWindow(column, row, kBlockWindows[i]));
      if (!plane.valid) continue;
      if (i == 0) {
        const CurvedWindow curved = FitCurve(column, row, plane);
        if (curved.valid &&
            curved.residual_variance <= limit + kRipple * allowed_bend * allowed_bend) {
          bend = curved.bend;
          plane.residual_variance = curved.residual_variance;
          return plane;  // one smooth piece of surface: no need to look at parts
        }
      }
      if (plane.residual_variance > limit + allowed_bend * allowed_bend) continue;
      const float deviation = own_w - plane.At(own_u, own_v);
      const float expected = noise_variance * (1.0F / own.n + plane.Leverage(own_u, own_v));
      if (deviation * deviation > 9.0F * expected + allowed_bend * allowed_bend) continue;
      if (!best.valid || plane.residual_variance < best.residual_variance) {
        best = plane;
        bend = CurvedWindow::Shrunk(deviation, expected);
      }
      if (i == 0 && plane.residual_variance <= limit) break;
    }
    return best;
  }

  [[nodiscard]] CurvedWindow FitCurve(int column, int row,
                                      const InverseDepthPlane& plane) const noexcept {
    if (column < 1 || row < 1 || column + 1 >= columns_ || row + 1 >= rows_) return {};
    CurvedWindow::Blocks blocks;
    for (int i = 0; i < 9; ++i)
      blocks[static_cast<std::size_t>(i)] = &block(column + i % 3 - 1, row + i / 3 - 1);
    return CurvedWindow::Fit(blocks, plane, static_cast<float>(block_px_ * block_px_),
                             noise_std_ * noise_std_);
  }

  [[nodiscard]] bool MakeSample(const PinholeCamera& camera, const SamplerConfig& config,
                                int column, int row, const PixelMoments& own,
                                const InverseDepthPlane& plane, float bend,
                                SurfaceSample& sample) const noexcept {
    const float half = 0.5F * static_cast<float>(block_px_ - 1);
    const float du = own.u / own.n;
    const float dv = own.v / own.n;
    const float u = static_cast<float>(origin_u_ + column * block_px_) + half + du;
    const float v = static_cast<float>(origin_v_ + row * block_px_) + half + dv;
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
    sample.cos_incidence = w / (g_norm * ray_norm);
    if (sample.cos_incidence < config.min_cos_incidence) return false;
    // dz = z^2 dw along the ray; projected onto the normal.
    const float effective_std =
        std::sqrt(std::fmax(noise_std_ * noise_std_, plane.residual_variance));
    const float along_normal = depth_m * depth_m * ray_norm * sample.cos_incidence * effective_std;
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

  static constexpr int kNoiseBlocks = 512;
  static constexpr float kRipple =
      0.05F;  ///< Third order allowed, as share of the second, squared.

  /// Full blocks and the partly covered ones along the outline.
  static constexpr int kMaxFilledBlocks = Limits::kMaxSurfaceSamples * 5 / 4;
  static_assert(kMaxFilledBlocks <= 65536 && Limits::kMaxSurfaceSamples < 65535);
  static constexpr std::uint16_t kEmptyBlock = 0;
  static constexpr std::uint16_t kNoSample = 65535;

  /// Per block of the grid where its sums are; blocks without pixels share the first.
  std::array<std::uint16_t, static_cast<std::size_t>(Limits::kMaxBlocks)> grid_;
  std::array<PixelMoments, static_cast<std::size_t>(kMaxFilledBlocks)> moments_;
  std::array<std::uint16_t, static_cast<std::size_t>(kMaxFilledBlocks)> sample_of_;
  std::array<float, static_cast<std::size_t>(kNoiseBlocks)> residuals_;
  const Samples* samples_ = nullptr;  ///< Of the last frame, for SurfaceAt().
  int filled_ = 0;
  int origin_u_ = 0;
  int origin_v_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  int block_px_ = 1;
  float noise_std_ = 0.0F;
};

}  // namespace disflow
