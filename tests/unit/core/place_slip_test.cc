// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/place_slip.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace disflow {
namespace {

constexpr StampNs kFrame_ns = 33'333'333;
constexpr float kStep_m = 0.005F;
constexpr int kPlaces = 12;
const Vec3 kAlong = Vec3(1.0F, 2.0F, -2.0F) / 3.0F;

Mat6 FreeBy(float std_m) {
  Mat6 covariance = Mat6::Zero();
  covariance.topLeftCorner<3, 3>() = std_m * std_m * kAlong * kAlong.transpose();
  return covariance;
}

class PlaceSlipTest : public ::testing::Test {
 protected:
  PlaceSlipTest() { slip_.Start(now_ns_); }
  /// @return Whether the place is known again after some frame.
  bool Run(int frames, bool unheld, bool by_known, float slid_m = 0.0F) {
    bool known = false;
    for (int i = 0; i < frames; ++i) {
      now_ns_ += kFrame_ns;
      const bool was_free = slip_.free();
      slip_.Learn(now_ns_, unheld, FreeBy(slid_m), 1.0F, by_known);
      known = known || (was_free && !slip_.free());
    }
    return known;
  }
  bool Held(int frames, bool by_known) { return Run(frames, false, by_known); }
  bool Unheld(int frames, float slid_m) { return Run(frames, true, false, slid_m); }

  PlaceSlip slip_;
  StampNs now_ns_ = 1'000'000'000;
};

TEST_F(PlaceSlipTest, ObjectThatIsHeld_HasNotSlid) {
  Held(50, true);
  EXPECT_FALSE(slip_.free());
  EXPECT_TRUE(slip_.Covariance(Mat6::Zero(), 0.0F).isZero(0.0F));
}

TEST_F(PlaceSlipTest, TwoFramesThatTellNothing_AreNoSlide) {
  Unheld(2, 0.03F);
  EXPECT_FALSE(slip_.free());
  Held(1, true);
  EXPECT_TRUE(slip_.Covariance(Mat6::Zero(), 0.0F).isZero(0.0F));
}

// At any rate of frames: two of them may be a second apart.
TEST_F(PlaceSlipTest, RareFramesThatHoldIt_AreNoSlide) {
  for (int i = 0; i < 5; ++i) {
    now_ns_ += 1'000'000'000;
    slip_.Learn(now_ns_, false, Mat6::Zero(), 1.0F, true);
    EXPECT_FALSE(slip_.free());
  }
}

TEST_F(PlaceSlipTest, WhatIsNewHoldsIt_AndItsPlaceStaysAsUncertain) {
  Unheld(10, 0.1F);
  EXPECT_TRUE(slip_.free());
  EXPECT_FALSE(Held(100, false));
  EXPECT_TRUE(slip_.free());
  EXPECT_TRUE(slip_.Covariance(Mat6::Zero(), 0.0F).isApprox(FreeBy(0.1F)));
}

TEST_F(PlaceSlipTest, SlidesAfterEachOther_AddUp) {
  for (int i = 0; i < 3; ++i) {
    Unheld(10, 0.1F);
    Held(10, false);
  }
  EXPECT_TRUE(slip_.Covariance(Mat6::Zero(), 0.0F).isApprox(3.0F * FreeBy(0.1F)));
}

TEST_F(PlaceSlipTest, WhatWasKnownHoldsItInThreeFramesInARow_AndItsPlaceIsKnown) {
  Unheld(10, 0.1F);
  for (int i = 0; i < 5; ++i) {
    EXPECT_FALSE(Held(2, true));
    EXPECT_FALSE(Held(1, false));
  }
  EXPECT_TRUE(Held(3, true));
  EXPECT_FALSE(slip_.free());
  EXPECT_TRUE(slip_.Covariance(Mat6::Zero(), 0.0F).isZero(0.0F));
}

// A frame says the direction with its noise.
TEST_F(PlaceSlipTest, DirectionOfASlide_IsThatOfAllOfItsFrames) {
  constexpr int kFrames = 20;
  const Vec3 across = kAlong.unitOrthogonal();
  constexpr float kNoise_rad = 0.03F;
  for (int i = 0; i < kFrames; ++i) {
    const Vec3 said = (kAlong + (i % 2 == 0 ? kNoise_rad : -kNoise_rad) * across).normalized();
    Mat6 free = Mat6::Zero();
    free.topLeftCorner<3, 3>() = said * said.transpose();
    now_ns_ += kFrame_ns;
    slip_.Learn(now_ns_, true, free, 0.2F, false);
  }
  Held(1, false);
  const Mat3 slid = slip_.Covariance(Mat6::Zero(), 0.0F).topLeftCorner<3, 3>();
  EXPECT_NEAR(std::sqrt(kAlong.dot(slid * kAlong)), 0.2F, 1e-3F);
  EXPECT_NEAR(std::sqrt(across.dot(slid * across)), kNoise_rad * 0.2F, 1e-3F);
  EXPECT_NEAR(across.dot(slid * kAlong), 0.0F, 1e-6F);
}

TEST_F(PlaceSlipTest, IsLookedForToBothSides_AsFarAsItMayHaveSlid_OverAndOver) {
  constexpr float kSlid_m = 0.1F;
  Unheld(10, kSlid_m);
  for (int round = 0; round < 2; ++round) {
    std::vector<float> places_m;
    for (int part = 0; part < 4; ++part) {
      const FreeShift shift = slip_.Next(Vec3::Zero(), 1.0F, kStep_m, kPlaces);
      ASSERT_NEAR(std::abs(shift.direction.dot(kAlong)), 1.0F, 1e-5F);
      for (int i = 0; i < kPlaces; ++i) places_m.push_back(shift.Place(i, kPlaces).dot(kAlong));
    }
    std::sort(places_m.begin(), places_m.end());
    EXPECT_LE(places_m.front(), -kSlid_m);
    EXPECT_GE(places_m.back(), kSlid_m);
    for (std::size_t i = 1; i < places_m.size(); ++i) {
      EXPECT_LT(places_m[i] - places_m[i - 1], 2.01F * kStep_m);
    }
  }
}

TEST_F(PlaceSlipTest, IsLookedForNoFartherThanTheModelReaches) {
  Unheld(10, 0.3F);
  constexpr float kReach_m = 0.02F;
  for (int part = 0; part < 20; ++part) {
    const FreeShift shift = slip_.Next(Vec3::Zero(), kReach_m, kStep_m, kPlaces);
    for (int i = 0; i < kPlaces; ++i) {
      EXPECT_LE(shift.Place(i, kPlaces).norm(), kReach_m + kStep_m * kPlaces);
    }
  }
}

}  // namespace
}  // namespace disflow
