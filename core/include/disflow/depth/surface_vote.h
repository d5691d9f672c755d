// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow {

/// What mask, model and surroundings say of one connected surface.
struct SurfaceVote {
  bool chosen = false;
  int pixels = 0;
  int masked = 0;     ///< Its pixels within the mask.
  int probed = 0;     ///< Its points that the model was asked about.
  int explained = 0;  ///< Of these, those near known surface.
  int outline = 0;    ///< Ends of its pixels in rows, and in columns.
  int ends = 0;       ///< Of these, those where it goes on to where the object cannot be.
};

/// Whether a surface is the object's, once there is a model and without a mask.
[[nodiscard]] bool BelongsToObject(const SurfaceVote& vote) noexcept;

/// The same under a mask; the model was only asked about what the mask covers.
[[nodiscard]] bool BelongsToMaskedObject(const SurfaceVote& vote) noexcept;

/// Whether a surface goes on where the object cannot be, as that of a table does.
[[nodiscard]] bool GoesOn(const SurfaceVote& vote) noexcept;

/// Whether a surface is as ragged as what noise leaves of a table: in the mean narrower than 4 px,
/// where a camera's noise hangs together over one to three. Twice its pixels over its outline is
/// the width of a strip.
[[nodiscard]] bool IsRagged(const SurfaceVote& vote) noexcept;

inline constexpr int kCrumbPercent = 10;  ///< Smaller shares are what noise cuts off of a surface.

/// Of surfaces that were cut at their valleys, those that still go on are what the object stands
/// on, unless the model explains little of the others: then the object could not be cut off, and
/// all that the model explains some of is chosen.
/// @param votes Of `count` surfaces, chosen as if nothing was near the object.
/// @param most_new So many of the object's points may have come into view by its turn.
/// @return Whether the object was cut off.
[[nodiscard]] bool ChooseOfCut(SurfaceVote* votes, int count, float most_new = 0.0F) noexcept;

/// Chooses LargestThatEnds() instead of what was chosen if that is nothing, or crumbs of which the
/// model was not even asked: the prediction is far off then.
void ChooseLargestInsteadOfCrumbs(SurfaceVote* votes, int count) noexcept;

/// Of `count` surfaces the largest that does not go on where the object cannot be, if it is more
/// than a crumb beside the largest of all, which it is otherwise.
[[nodiscard]] int LargestThatEnds(const SurfaceVote* votes, int count) noexcept;

}  // namespace disflow
