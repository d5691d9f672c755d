// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/surface_vote.h"

#include <gtest/gtest.h>

#include <array>

namespace disflow {
namespace {

/// Of the object, cut off from what it stands on.
SurfaceVote Own() {
  SurfaceVote vote;
  vote.chosen = true;
  vote.pixels = 6000;
  vote.probed = 100;
  vote.explained = 97;
  vote.outline = 500;
  return vote;
}

SurfaceVote Table() {
  SurfaceVote vote;
  vote.pixels = 30000;
  vote.probed = 500;
  vote.explained = 40;
  vote.outline = 1400;
  vote.ends = 120;
  return vote;
}

TEST(SurfaceVote, SurfaceWhoseRowsEndAtNothing_GoesOn) {
  EXPECT_TRUE(GoesOn(Table()));
  EXPECT_FALSE(GoesOn(Own()));
  // A few pixels of noise are no table.
  SurfaceVote noisy = Own();
  noisy.ends = 7;
  EXPECT_FALSE(GoesOn(noisy));
}

// The outlines of the holes say nothing of where the surface ends.
TEST(SurfaceVote, SurfaceThatNoiseHasRiddledWithHoles_GoesOnAllTheSame) {
  SurfaceVote riddled = Table();
  riddled.outline = 14000;
  EXPECT_TRUE(GoesOn(riddled));
  riddled.ends = 15;
  EXPECT_FALSE(GoesOn(riddled));
}

TEST(SurfaceVote, PiecesAsNarrowAsNoise_AreRaggedAndThingsAreNot) {
  const auto of_rectangle = [](int width_px, int height_px) {
    SurfaceVote vote;
    vote.pixels = width_px * height_px;
    vote.outline = 2 * (width_px + height_px);
    return vote;
  };
  EXPECT_TRUE(IsRagged(of_rectangle(3, 60)));
  EXPECT_TRUE(IsRagged(of_rectangle(60, 3)));
  EXPECT_FALSE(IsRagged(of_rectangle(5, 60)));
  // The smallest thing that is looked for, a disc of 12 pixels.
  SurfaceVote disc;
  disc.pixels = 115;
  disc.outline = 4 * 12;
  EXPECT_FALSE(IsRagged(disc));
  EXPECT_FALSE(IsRagged(Own()));
}

TEST(SurfaceVote, ObjectThatWasCutOff_IsChosenWithoutItsTable) {
  std::array votes{Table(), Own()};
  votes[0].chosen = true;  // near the model's foot a third of it is explained
  EXPECT_TRUE(ChooseOfCut(votes.data(), 2));
  EXPECT_FALSE(votes[0].chosen);
  EXPECT_TRUE(votes[1].chosen);
}

TEST(SurfaceVote, TwoPartsOfTheObject_AreBothChosenButNoCrumbs) {
  std::array votes{Own(), Own(), Own()};
  votes[1].pixels = 700;
  votes[2].pixels = 500;
  EXPECT_TRUE(ChooseOfCut(votes.data(), 3));
  EXPECT_TRUE(votes[0].chosen);
  EXPECT_TRUE(votes[1].chosen);
  EXPECT_FALSE(votes[2].chosen);
}

TEST(SurfaceVote, ObjectInOnePieceWithItsTable_IsChosenButNotCutOff) {
  SurfaceVote both = Table();
  both.explained = 130;
  std::array votes{both};
  EXPECT_FALSE(ChooseOfCut(votes.data(), 1));
  EXPECT_TRUE(votes[0].chosen);
}

TEST(SurfaceVote, SurfaceOfWhichTheModelKnowsTooLittle_IsNotCutOff) {
  SurfaceVote leaking = Own();
  leaking.explained = 80;
  std::array votes{leaking};
  EXPECT_FALSE(ChooseOfCut(votes.data(), 1));
  EXPECT_TRUE(votes[0].chosen);
}

TEST(SurfaceVote, SurfaceThatATurnMayHaveBroughtIntoView_DoesNotMakeItUnknown) {
  SurfaceVote turned = Own();
  turned.explained = 80;
  std::array votes{turned};
  // As many as are missing of 85 %, and one less.
  const float missing = static_cast<float>(turned.probed) - 80.0F / 0.85F;
  EXPECT_FALSE(ChooseOfCut(votes.data(), 1, missing - 1.0F));
  EXPECT_TRUE(ChooseOfCut(votes.data(), 1, missing + 1.0F));
}

TEST(SurfaceVote, WhereTheModelExplainsNothing_TheChoiceStays) {
  SurfaceVote elsewhere = Own();
  elsewhere.explained = 0;
  std::array votes{elsewhere, Table()};
  votes[1].explained = 0;
  EXPECT_TRUE(ChooseOfCut(votes.data(), 2));
  EXPECT_TRUE(votes[0].chosen);
  EXPECT_FALSE(votes[1].chosen);
}

TEST(SurfaceVote, LostObject_IsLookedForInWhatEndsButNotInCrumbs) {
  std::array votes{Table(), Own()};
  EXPECT_EQ(LargestThatEnds(votes.data(), 2), 1);
  votes[1].pixels = Table().pixels / 11;
  EXPECT_EQ(LargestThatEnds(votes.data(), 2), 0);
  EXPECT_EQ(LargestThatEnds(votes.data(), 1), 0);
}

TEST(SurfaceVote, CrumbThatNobodyAskedAbout_DoesNotStandForAnObjectThatMovedOtherwise) {
  // The prediction is so far off that the model explains next to nothing of the object itself.
  SurfaceVote object = Own();
  object.chosen = false;
  object.explained = 10;
  SurfaceVote crumb;
  crumb.chosen = true;
  crumb.pixels = 32;
  std::array votes{crumb, object};
  ChooseLargestInsteadOfCrumbs(votes.data(), 2);
  EXPECT_FALSE(votes[0].chosen);
  EXPECT_TRUE(votes[1].chosen);
  // A part of the object as large as a fifth of something else is none.
  votes[0].pixels = object.pixels / 5;
  votes[0].chosen = true;
  votes[1].chosen = false;
  ChooseLargestInsteadOfCrumbs(votes.data(), 2);
  EXPECT_TRUE(votes[0].chosen);
  EXPECT_FALSE(votes[1].chosen);
}

TEST(SurfaceVote, UnderAMask_OnlyAModelThatPlainlyContradictsKeepsASurfaceOut) {
  SurfaceVote vote = Own();
  vote.masked = vote.pixels;
  EXPECT_TRUE(BelongsToMaskedObject(vote));
  vote.explained = 9;
  EXPECT_FALSE(BelongsToMaskedObject(vote));
  vote.explained = 29;
  EXPECT_TRUE(BelongsToMaskedObject(vote));
  vote.masked = vote.pixels / 3;  // most of it is outside
  EXPECT_FALSE(BelongsToMaskedObject(vote));
}

}  // namespace
}  // namespace disflow
