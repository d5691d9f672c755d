// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config.h"

namespace disflow {

/// How many times coarser than set the octree's leaves must be, so that there are local GPs for an
/// object's whole surface. A convex body's surface is four times what it covers of an image on
/// average over all directions (Cauchy), and a surface at any angle passes through 1.5 cells per
/// squared edge of theirs on average. An addition to the paper.
/// @param seen_m2 What the object's first view covers, across the viewing rays.
/// @param clusters As many as there is memory for.
/// @return At least 1; at most as much as lets samples of the field, which then lie as much farther
///     apart, be found within RegistrationConfig::match_radius_m. 1 if
///     FieldConfig::fit_to_object is 0.
[[nodiscard]] float CoarsenessFor(float seen_m2, int clusters, const Config& config) noexcept;

/// A field with so many times larger cells, and with what goes with them: how far samples lie
/// apart, and how far beyond a cell samples of its neighbours are trained on.
[[nodiscard]] FieldConfig Coarser(const FieldConfig& config, float coarseness) noexcept;

}  // namespace disflow
