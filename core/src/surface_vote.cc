// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/surface_vote.h"

#include <algorithm>
#include <cmath>

namespace disflow {

bool BelongsToObject(const SurfaceVote& vote) noexcept {
  return vote.probed == 0 || 10 * vote.explained >= 3 * vote.probed;
}

bool BelongsToMaskedObject(const SurfaceVote& vote) noexcept {
  if (vote.masked == 0) return false;
  const bool mostly_outside = 2 * vote.masked < vote.pixels;
  constexpr int kMinProbed = 4;
  if (vote.probed < kMinProbed) return !mostly_outside;
  // Where the mask has most of it, only a model that plainly contradicts keeps it out.
  return 10 * vote.explained >= (mostly_outside ? 3 : 1) * vote.probed;
}

bool GoesOn(const SurfaceVote& vote) noexcept {
  constexpr int kMinEnds = 8;
  // Of a thing that was cut off nothing goes on, of a table under it a tenth and more of its rows,
  // each of which has two ends.
  constexpr float kMinShare = 0.015F;
  // What noise has riddled with holes has most of its outline around these. Four times the root of
  // its pixels is a square's, twice that one of 14 to 1.
  const float around = 8.0F * std::sqrt(static_cast<float>(vote.pixels));
  const float outline = std::min(static_cast<float>(vote.outline), around);
  return vote.ends >= kMinEnds && static_cast<float>(vote.ends) >= kMinShare * outline;
}

bool IsRagged(const SurfaceVote& vote) noexcept {
  constexpr int kMinWidth_px = 4;
  return 2 * vote.pixels < kMinWidth_px * vote.outline;
}

bool ChooseOfCut(SurfaceVote* votes, int count, float most_new) noexcept {
  // Of what was in view before, noise and the margins about it leave more unknown to no model.
  constexpr int kMinKnownPercent = 85;
  int explained = 0;
  SurfaceVote own;
  for (int c = 0; c < count; ++c) {
    explained += votes[c].explained;
    if (!votes[c].chosen || GoesOn(votes[c])) continue;
    own.explained += votes[c].explained;
    own.probed += votes[c].probed;
    own.pixels = std::max(own.pixels, votes[c].pixels);
  }
  if (explained == 0) return true;
  const float in_view_before = static_cast<float>(own.probed) - most_new;
  const bool cut_off = 2 * own.explained > explained &&
                       static_cast<float>(100 * own.explained) >= kMinKnownPercent * in_view_before;
  for (int c = 0; c < count; ++c) {
    SurfaceVote& vote = votes[c];
    vote.chosen =
        cut_off ? vote.chosen && !GoesOn(vote) && 100 * vote.pixels >= kCrumbPercent * own.pixels
                : 100 * vote.explained >= kCrumbPercent * explained;
  }
  return cut_off;
}

void ChooseLargestInsteadOfCrumbs(SurfaceVote* votes, int count) noexcept {
  if (count == 0) return;
  const int largest = LargestThatEnds(votes, count);
  int chosen_pixels = 0;
  for (int c = 0; c < count; ++c)
    if (votes[c].chosen) chosen_pixels += votes[c].pixels;
  if (chosen_pixels > 0 && 100 * chosen_pixels >= kCrumbPercent * votes[largest].pixels) return;
  for (int c = 0; c < count; ++c) votes[c].chosen = c == largest;
}

int LargestThatEnds(const SurfaceVote* votes, int count) noexcept {
  int largest = 0;
  int own = -1;
  for (int c = 0; c < count; ++c) {
    if (votes[c].pixels > votes[largest].pixels) largest = c;
    if (!GoesOn(votes[c]) && (own < 0 || votes[c].pixels > votes[own].pixels)) own = c;
  }
  const bool is_crumb = own < 0 || 100 * votes[own].pixels < kCrumbPercent * votes[largest].pixels;
  return is_crumb ? largest : own;
}

}  // namespace disflow
