// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "colour_map.h"
#include "disflow/surface_extractor.h"

namespace disflow::apps {

/// Collects the streamed surface as an indexed mesh: vertices that triangles share are kept once.
class SurfaceMesh final : public TriangleSink {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// The standard deviations between which colours run from dark (certain) to bright (uncertain).
  struct StdRange {
    float low_m = 0.0F;
    float high_m = 0.0F;
  };

  [[nodiscard]] const std::vector<SurfaceVertex>& vertices() const noexcept { return vertices_; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const noexcept { return triangles_; }

  /// 2nd and 98th percentile of std_m: a few badly known vertices at the rim do not decide the
  /// colours of all others.
  [[nodiscard]] StdRange ColouredRange() const;
  /// One colour per vertex.
  [[nodiscard]] std::vector<Colour> Colours() const;

  /// @return Binary PLY: x y z nx ny nz red green blue std_m and faces. A comment in the header
  /// names the coloured range.
  [[nodiscard]] std::string FormatPly() const;
  /// @return Wavefront OBJ: v x y z red green blue, vn, f. The coloured range is a comment, std_m
  /// itself has no place in this format.
  [[nodiscard]] std::string FormatObj() const;

 private:
  using Key = std::array<std::uint32_t, 3>;  ///< The position's bits.
  struct KeyHash {
    std::size_t operator()(const Key& key) const noexcept;
  };

  void DoOnTriangle(const SurfaceVertex& a, const SurfaceVertex& b,
                    const SurfaceVertex& c) noexcept override;
  [[nodiscard]] std::uint32_t IndexOf(const SurfaceVertex& vertex);

  std::vector<SurfaceVertex> vertices_;
  std::vector<Triangle> triangles_;
  std::unordered_map<Key, std::uint32_t, KeyHash> index_;
};

}  // namespace disflow::apps
