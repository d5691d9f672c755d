// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow {

/// Two windows of a surface beside its outline, as the image shows how it runs towards it.
struct OutlineProfile {
  float cos_near = 0.0F;       ///< Cosine of incidence next to the outline,
  float cos_inner = 0.0F;      ///< and farther in.
  float near_m = 0.0F;         ///< From the outline to the former, across the rays,
  float inner_m = 0.0F;        ///< and to the latter.
  float variance_rad2 = 0.0F;  ///< Of the angle between the two.
};

/// How far behind the place where the surface beside it, taken for flat, meets the outline's ray
/// the outline may be: root mean square along the ray. A flat face ends there, at an edge. A round
/// one bends on until the ray touches it, and the outline is no part of the object: it stays where
/// it is while the object turns. Which of the two it is, the angle between the windows says, as far
/// as noise lets it.
[[nodiscard]] float ContourBend(const OutlineProfile& profile) noexcept;

}  // namespace disflow
