// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Planes are fitted in (u, v, w = 1/z): there a plane is affine in the pixel coordinates and the
/// noise of a stereo or structured-light sensor is the same everywhere.

namespace disflow {

/// Sums over the pixels of one block, relative to a pixel (u0, v0) and a reference inverse depth,
/// so that float suffices.
/// @tparam Number float, or an array of them: as many blocks side by side.
template <class Number>
struct MomentsOf {
  // No initial values: thousands of blocks lie in memory that is new in every frame.
  Number n;
  Number u, v, w;
  Number uu, uv, vv;
  Number uw, vw, ww;
  Number w_reference;  ///< [1/m]

  /// Adds another block's sums, whose origin lies (du, dv) pixels from this one's, to a block that
  /// holds pixels. A block without any adds nothing.
  void Add(const MomentsOf& other, float du, float dv) noexcept {
    const Number dw = other.w_reference - w_reference;
    n += other.n;
    u += other.u + other.n * du;
    v += other.v + other.n * dv;
    w += other.w + other.n * dw;
    uu += other.uu + du * (2.0F * other.u + other.n * du);
    vv += other.vv + dv * (2.0F * other.v + other.n * dv);
    uv += other.uv + du * other.v + dv * other.u + other.n * du * dv;
    uw += other.uw + du * other.w + dw * other.u + other.n * du * dw;
    vw += other.vw + dv * other.w + dw * other.v + other.n * dv * dw;
    ww += other.ww + dw * (2.0F * other.w + other.n * dw);
  }
};

/// PixelMoments{} holds no pixel.
struct PixelMoments : MomentsOf<float> {
  /// Of the pixels' whole inverse depths [1/m].
  [[nodiscard]] float SumOfW() const noexcept { return n * w_reference + w; }
  /// Adds another block's sums, whose origin lies (du, dv) pixels from this one's.
  void Merge(const PixelMoments& other, float du, float dv) noexcept {
    if (other.n == 0.0F) return;
    if (n == 0.0F) w_reference = other.w_reference;
    Add(other, du, dv);
  }
};

/// w = mean_w + slope_u (u - mean_u) + slope_v (v - mean_v), fitted to PixelMoments.
struct InverseDepthPlane {
  bool valid = false;
  float n = 0.0F;
  float mean_u = 0.0F, mean_v = 0.0F;    ///< Relative to the moments' origin [px].
  float mean_w = 0.0F;                   ///< [1/m]
  float slope_u = 0.0F, slope_v = 0.0F;  ///< [1/(m px)]
  float residual_variance = 0.0F;        ///< Per pixel, unbiased [1/m^2].
  float inverse_uu = 0.0F, inverse_uv = 0.0F,
        inverse_vv = 0.0F;  ///< Inverse scatter of the pixels: slope covariance / variance.

  [[nodiscard]] float At(float u, float v) const noexcept {
    return mean_w + slope_u * (u - mean_u) + slope_v * (v - mean_v);
  }
  /// Variance of At(u, v) per unit of pixel variance.
  [[nodiscard]] float Leverage(float u, float v) const noexcept {
    const float du = u - mean_u;
    const float dv = v - mean_v;
    return 1.0F / n + inverse_uu * du * du + 2.0F * inverse_uv * du * dv + inverse_vv * dv * dv;
  }

  /// Not valid if there are too few pixels, or (nearly) all on one line.
  [[nodiscard]] static InverseDepthPlane Fit(const PixelMoments& m) noexcept;
};

}  // namespace disflow
