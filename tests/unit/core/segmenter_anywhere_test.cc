// SPDX-License-Identifier: BSD-3-Clause
#include "segmenter_scene.h"

namespace disflow::testing {
namespace {

/// As large as kObject, and 0.4 m behind it: out of reach of a search about it.
constexpr PixelBox kElsewhere{8, 30, 36, 58};
constexpr float kElsewhere_m = 1.2F;

/// A lost object that may be anywhere in the image.
class LostObject : public LaterFrame {
 protected:
  LostObject() {
    prior_.doubtful = true;
    prior_.unseen_s = 2.0F;
    prior_.anywhere = true;
  }
};

TEST_F(LostObject, ElsewhereInTheImage_IsFoundWhole) {
  DepthScene scene(2.2F);
  scene.Rectangle(kElsewhere, kElsewhere_m);
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(kElsewhere);
  EXPECT_TRUE(segmenter_->elsewhere());
  prior_.anywhere = false;
  EXPECT_EQ(Segment(scene), Status::kNoValidDepth);
}

TEST_F(LostObject, AcrossTheEdgeOfWhereItIsPredicted_IsNotCutOffThere) {
  DepthScene scene(2.2F);
  const PixelBox across{kObject.u_min - 30, kObject.v_min, kObject.u_max - 30, kObject.v_max};
  scene.Rectangle(across, kObject_m);
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(across);
  prior_.anywhere = false;
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_LT(Share(across), 1.0);
}

TEST_F(LostObject, WhereItIsPredicted_IsNotElsewhere) {
  DepthScene scene(2.2F);
  scene.Rectangle(kObject, kObject_m);
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(kObject);
  EXPECT_FALSE(segmenter_->elsewhere());
}

TEST_F(LostObject, OnATable_IsFoundWithoutIt) {
  DepthScene scene(2.2F);
  scene.Table().Rectangle(kElsewhere, kElsewhere_m);
  ASSERT_EQ(Segment(scene), Status::kOk);
  EXPECT_EQ(Share(kElsewhere), 1.0);
  EXPECT_LT(object_->count(), 1.05 * kElsewhere.width() * kElsewhere.height());
}

TEST_F(LostObject, ThingsOfOtherSizes_AreNotTaken) {
  DepthScene scene(2.2F);
  scene.Rectangle({0, 0, 150, 20}, kElsewhere_m);  // Four times as long.
  scene.Rectangle({8, 70, 16, 78}, kElsewhere_m);  // A third of its size.
  EXPECT_EQ(Segment(scene), Status::kNoValidDepth);
  EXPECT_FALSE(segmenter_->elsewhere());
}

TEST_F(LostObject, OfSeveralThings_IsTheOneNearestToItsPrediction) {
  DepthScene scene(2.2F);
  scene.Rectangle(kElsewhere, kElsewhere_m).Rectangle({120, 85, 142, 107}, kElsewhere_m + 0.3F);
  ASSERT_EQ(Segment(scene), Status::kOk);
  ExpectExactly(kElsewhere);
}

}  // namespace
}  // namespace disflow::testing
