// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "disflow/host/random.h"

namespace disflow::host {

/// Standard normal numbers from a table: the same on every machine, and cheap.
class NormalTable {
 public:
  NormalTable();
  static constexpr unsigned kBits = 12;
  [[nodiscard]] float Draw(BitSource& bits) const { return quantiles_[bits.Take(kBits)]; }

 private:
  std::vector<float> quantiles_;
};

/// Gaussian noise of variance 1 whose neighbours in an image are alike: independent numbers
/// convolved with a Gaussian kernel of standard deviation s, so that the correlation of two pixels
/// r apart is exp(-r^2 / (4 s^2)). Goes on over the image's border as on a torus.
void DrawSmoothNoise(const NormalTable& normal, RandomNumbers& random, double kernel_std_px,
                     int width_px, int height_px, std::vector<float>& noise);

struct ImageNoiseModel {
  double kernel_std_px = 0.0;     ///< s of DrawSmoothNoise().
  double rest_correlation = 0.0;  ///< Between frames, of a pixel whose disparity does not change.
  double layer_px = 1.0;          ///< The pattern is another one after such a change of disparity.
};

/// The error of a matched disparity, variance 1. One part of it is drawn anew with every frame. The
/// other belongs to pixel and disparity: a surface at rest keeps it for ever, one that slides along
/// its own plane moves through it, and one that comes nearer finds another one.
class ImageNoise {
 public:
  ImageNoise(const ImageNoiseModel& model, int width_px, int height_px, std::uint64_t seed);

  /// Draws what is new in a frame; depends on the seed and the frame's number only.
  void StartFrame(int frame);
  /// @param set Independent errors for one pixel, from 0 on.
  [[nodiscard]] float At(int u, int v, float disparity_px, std::uint32_t set = 0) const;

 private:
  struct Shift {
    int u = 0;
    int v = 0;
  };
  static constexpr std::size_t kShifts = 256;
  [[nodiscard]] float Shifted(const std::vector<float>& noise, int u, int v,
                              std::uint32_t shift) const;

  ImageNoiseModel model_;
  int width_;
  int height_;
  std::uint64_t seed_;
  float kept_share_;
  float fresh_share_;
  NormalTable normal_;
  std::array<Shift, kShifts> shifts_;  ///< Where each layer of disparity reads the kept noise.
  std::vector<float> kept_;
  std::vector<float> fresh_;
};

}  // namespace disflow::host
