// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace disflow {

/// An edge of the tetrahedra in a cube, between two of its corners. Bit 0, 1, 2 of a corner is its
/// x, y, z; `low` has a subset of `high`'s bits, so neighbouring cubes name a shared edge alike.
struct CubeEdge {
  std::uint8_t low;
  std::uint8_t high;
};

/// The triangles that separate the inside corners of a cube from the others: the cube is cut into
/// the six tetrahedra around its main diagonal, one per order of the axes, which fit those of the
/// neighbouring cubes. Calls visit(CubeEdge, CubeEdge, CubeEdge) per triangle, counter-clockwise
/// seen from outside.
/// @param inside Bit i says whether corner i is inside.
template <class Visitor>
void MarchTetrahedra(unsigned inside, Visitor&& visit) noexcept {
  if (inside == 0U || inside == 0xFFU) return;
  // Corners of a tetrahedron in ascending order, of positive volume where the axes are an even
  // permutation of x, y, z.
  constexpr std::array<std::array<std::uint8_t, 4>, 6> kTetrahedra{
      {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 4, 6, 7}}};
  for (std::size_t t = 0; t < kTetrahedra.size(); ++t) {
    // Inside corners first; every exchange mirrors the tetrahedron.
    std::array<std::uint8_t, 4> corner = kTetrahedra[t];
    bool mirrored = t >= 3;
    int count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if ((inside >> corner[i] & 1U) == 0U) continue;
      for (std::size_t k = i; k > static_cast<std::size_t>(count); --k) {
        const std::uint8_t moved = corner[k];
        corner[k] = corner[k - 1];
        corner[k - 1] = moved;
        mirrored = !mirrored;
      }
      ++count;
    }
    const auto edge = [&corner](std::size_t a, std::size_t b) {
      return corner[a] < corner[b] ? CubeEdge{corner[a], corner[b]}
                                   : CubeEdge{corner[b], corner[a]};
    };
    const auto triangle = [&](CubeEdge a, CubeEdge b, CubeEdge c) {
      if (mirrored) {
        visit(a, c, b);
      } else {
        visit(a, b, c);
      }
    };
    if (count == 1) {
      triangle(edge(0, 1), edge(0, 2), edge(0, 3));
    } else if (count == 2) {
      triangle(edge(0, 2), edge(0, 3), edge(1, 3));
      triangle(edge(0, 2), edge(1, 3), edge(1, 2));
    } else if (count == 3) {
      triangle(edge(3, 0), edge(3, 1), edge(3, 2));
    }
  }
}

}  // namespace disflow
