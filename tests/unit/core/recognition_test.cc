// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/recognition.h"

#include <gtest/gtest.h>

namespace disflow {
namespace {

const Vec3 kCenter_c{0.1F, 0.0F, 0.7F};
constexpr StampNs kPeriod_ns = 33'333'333;

/// Turned and shifted at the object's centre.
PoseObjectFromCamera At(float turn_rad, float shift_m) {
  const Mat3 turn = ExpSo3(Vec3(0.0F, turn_rad, 0.0F));
  return {turn, Vec3(Vec3(shift_m, 0.0F, 0.0F) - turn * kCenter_c)};
}

TEST(Recognition, SecondFrameAtTheSamePlace_Confirms) {
  Recognition recognition;
  EXPECT_FALSE(recognition.Confirm(true, At(1.0F, 0.0F), kCenter_c, 1 * kPeriod_ns));
  EXPECT_TRUE(recognition.pending());
  EXPECT_EQ(recognition.T_oc().translation(), At(1.0F, 0.0F).translation());
  EXPECT_TRUE(recognition.Confirm(true, At(1.1F, 0.01F), kCenter_c, 2 * kPeriod_ns));
  EXPECT_FALSE(recognition.pending());
}

TEST(Recognition, AnotherPlaceOrTurn_BeginsAnew) {
  for (const PoseObjectFromCamera& other : {At(1.0F, 0.2F), At(2.0F, 0.0F)}) {
    Recognition recognition;
    EXPECT_FALSE(recognition.Confirm(true, At(1.0F, 0.0F), kCenter_c, 1 * kPeriod_ns));
    EXPECT_FALSE(recognition.Confirm(true, other, kCenter_c, 2 * kPeriod_ns));
    EXPECT_TRUE(recognition.Confirm(true, other, kCenter_c, 3 * kPeriod_ns));
  }
}

TEST(Recognition, OneDoubtfulFrameBetween_IsForgiven) {
  Recognition recognition;
  EXPECT_FALSE(recognition.Confirm(true, At(1.0F, 0.0F), kCenter_c, 1 * kPeriod_ns));
  EXPECT_FALSE(recognition.Confirm(false, At(1.2F, 0.03F), kCenter_c, 2 * kPeriod_ns));
  EXPECT_TRUE(recognition.pending());
  // It has moved on by then.
  EXPECT_TRUE(recognition.Confirm(true, At(1.4F, 0.06F), kCenter_c, 3 * kPeriod_ns));
}

TEST(Recognition, TwoDoubtfulFrames_BeginAnew) {
  Recognition recognition;
  EXPECT_FALSE(recognition.Confirm(true, At(1.0F, 0.0F), kCenter_c, 1 * kPeriod_ns));
  EXPECT_FALSE(recognition.Confirm(false, At(1.0F, 0.0F), kCenter_c, 2 * kPeriod_ns));
  EXPECT_FALSE(recognition.Confirm(false, At(1.0F, 0.0F), kCenter_c, 3 * kPeriod_ns));
  EXPECT_FALSE(recognition.pending());
  EXPECT_FALSE(recognition.Confirm(true, At(1.0F, 0.0F), kCenter_c, 4 * kPeriod_ns));
}

TEST(Recognition, RareImages_LetTheObjectMoveFartherBetween) {
  Recognition often;
  EXPECT_FALSE(often.Confirm(true, At(1.0F, 0.0F), kCenter_c, kPeriod_ns));
  EXPECT_FALSE(often.Confirm(true, At(1.5F, 0.08F), kCenter_c, 2 * kPeriod_ns));
  Recognition rarely;
  EXPECT_FALSE(rarely.Confirm(true, At(1.0F, 0.0F), kCenter_c, kPeriod_ns));
  EXPECT_TRUE(rarely.Confirm(true, At(1.5F, 0.08F), kCenter_c, 3 * kPeriod_ns));
}

TEST(Recognition, Suspicion_LastsForOneFrameAndConfirmsNothing) {
  Recognition recognition;
  EXPECT_FALSE(recognition.suspected());
  recognition.Consider(true, At(1.0F, 0.0F));
  EXPECT_TRUE(recognition.suspected());
  EXPECT_FALSE(recognition.pending());
  EXPECT_EQ(recognition.T_oc().translation(), At(1.0F, 0.0F).translation());
  // It was looked at twice by now.
  recognition.Consider(true, At(1.0F, 0.0F));
  EXPECT_FALSE(recognition.suspected());
  // It is no frame that recognised the object.
  EXPECT_FALSE(recognition.Confirm(true, At(1.0F, 0.0F), kCenter_c, kPeriod_ns));
  // What is recognised is kept.
  recognition.Consider(true, At(2.0F, 0.1F));
  EXPECT_FALSE(recognition.suspected());
  EXPECT_EQ(recognition.T_oc().translation(), At(1.0F, 0.0F).translation());
}

}  // namespace
}  // namespace disflow
