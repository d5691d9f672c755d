// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "disflow/surface_extractor.h"

namespace disflow::apps {

/// Collects the streamed surface as an indexed mesh: vertices that triangles share are kept once.
class SurfaceMesh final : public TriangleSink {
 public:
  [[nodiscard]] const std::vector<SurfaceVertex>& vertices() const noexcept { return vertices_; }
  [[nodiscard]] std::size_t triangle_count() const noexcept { return triangles_.size(); }

  /// @return Binary PLY: x y z nx ny nz red green blue std_m and faces. Colours run from dark
  /// (certain) to bright (uncertain) between the 2nd and the 98th percentile of std_m, which a
  /// comment in the header names.
  [[nodiscard]] std::string FormatPly() const;

 private:
  using Key = std::array<std::uint32_t, 3>;  ///< The position's bits.
  struct KeyHash {
    std::size_t operator()(const Key& key) const noexcept;
  };

  void DoOnTriangle(const SurfaceVertex& a, const SurfaceVertex& b,
                    const SurfaceVertex& c) noexcept override;
  [[nodiscard]] std::uint32_t IndexOf(const SurfaceVertex& vertex);

  std::vector<SurfaceVertex> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::unordered_map<Key, std::uint32_t, KeyHash> index_;
};

}  // namespace disflow::apps
