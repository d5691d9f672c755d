// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/tracking_monitor.h"

#include <gtest/gtest.h>

#include <limits>

namespace disflow {
namespace {

using Evidence = TrackingMonitor::Evidence;
constexpr StampNs kFrameStep_ns = 33'333'333;

Evidence Good() {
  return {.registered = true,
          .in_view = true,
          .score = 0.98F,
          .conflict = 0.0F,
          .visible = 0.9F,
          .inliers = 450,
          .points = 500,
          .position_std_m = 0.0005F,
          .rotation_std_rad = 0.005F,
          .position_to_model_std_m = 0.0003F,
          .rotation_to_model_std_rad = 0.003F};
}
/// The model contradicts the image where any camera would tell.
Evidence Contradicted(Evidence evidence, float share) {
  evidence.conflict = share;
  evidence.resolved_conflict = share;
  return evidence;
}
/// Something is there, and the model does not fit it.
Evidence InVain() {
  Evidence evidence;
  evidence.in_view = true;
  return evidence;
}
Evidence With(void (*spoil)(Evidence&)) {
  Evidence evidence = Good();
  spoil(evidence);
  return evidence;
}

class TrackingMonitorTest : public ::testing::Test {
 protected:
  TrackingMonitorTest() { monitor_.Start(config_, 0); }

  /// The next frame, as the tracker asks and tells.
  void Offer(Evidence evidence) {
    stamp_ns_ += kFrameStep_ns;
    evidence.registered = monitor_.Accepts(evidence, stamp_ns_);
    monitor_.Update(evidence, stamp_ns_);
  }
  void Offer(const Evidence& evidence, int frames) {
    for (int i = 0; i < frames; ++i) Offer(evidence);
  }
  void Track() {
    Offer(Good(), 10);
    ASSERT_EQ(monitor_.state(), TrackingState::kTracking);
  }
  [[nodiscard]] bool Accepts(const Evidence& evidence) const {
    return monitor_.Accepts(evidence, stamp_ns_ + kFrameStep_ns);
  }

  MonitorConfig config_;
  TrackingMonitor monitor_;
  StampNs stamp_ns_ = 0;
};

TEST_F(TrackingMonitorTest, FirstFrames_AreInitialising) {
  EXPECT_EQ(monitor_.state(), TrackingState::kInitialising);
  Offer(Good());
  EXPECT_EQ(monitor_.state(), TrackingState::kInitialising);
  Offer(Good(), 9);
  EXPECT_EQ(monitor_.state(), TrackingState::kTracking);
}

TEST_F(TrackingMonitorTest, FollowedPose_IsAcceptedOnLittle) {
  Track();
  EXPECT_TRUE(Accepts(With([](Evidence& e) { e.score = 0.31F; })));
  EXPECT_TRUE(Accepts(Contradicted(Good(), 0.39F)));
  EXPECT_TRUE(Accepts(With([](Evidence& e) { e.inliers = 80; })));
}

TEST_F(TrackingMonitorTest, FollowedPose_IsRefusedOnLess) {
  Track();
  EXPECT_FALSE(Accepts(With([](Evidence& e) { e.score = 0.29F; })));
  EXPECT_FALSE(Accepts(Contradicted(Good(), 0.41F)));
  EXPECT_FALSE(Accepts(With([](Evidence& e) { e.inliers = 70; })));
  EXPECT_FALSE(Accepts(With([](Evidence& e) { e.registered = false; })));
  EXPECT_FALSE(Accepts(With([](Evidence& e) { e.inliers = e.points = 0; })));
}

TEST_F(TrackingMonitorTest, WhatIsTooNarrowForTheCamera_RefusesNoPose_ButIsNoReasonForTrust) {
  Track();
  const Evidence edge_on = With([](Evidence& e) { e.conflict = 0.6F; });
  EXPECT_TRUE(Accepts(edge_on));
  Offer(edge_on);
  EXPECT_EQ(monitor_.state(), TrackingState::kDegraded);
  EXPECT_FALSE(monitor_.Recognises(edge_on));
}

TEST_F(TrackingMonitorTest, PoseThatClaimsMoreThanUsual_MayHaveSlid) {
  Track();
  EXPECT_FALSE(monitor_.contradicted());
  Offer(Contradicted(Good(), 0.12F));
  EXPECT_TRUE(monitor_.contradicted());
  Offer(Good());
  EXPECT_FALSE(monitor_.contradicted());
  // What a sensor always shows is no news.
  Offer(Contradicted(Good(), 0.09F), 100);
  Offer(Contradicted(Good(), 0.17F));
  EXPECT_FALSE(monitor_.contradicted());
  Offer(Contradicted(Good(), 0.21F));
  EXPECT_TRUE(monitor_.contradicted());
  monitor_.Start(config_, stamp_ns_);
  EXPECT_FALSE(monitor_.contradicted());
}

TEST_F(TrackingMonitorTest, FollowedPoseOfANoisySensor_MayHaveFewerInliers_IfAllElseIsAsUsual) {
  // Its noise is worse than it is taken for: a quarter of the points are inliers at best.
  const Evidence usual = With([](Evidence& e) {
    e.score = 0.8F;
    e.inliers = 125;
  });
  Offer(usual, 100);
  const Evidence few = With([](Evidence& e) {
    e.score = 0.75F;
    e.inliers = 60;
  });
  EXPECT_TRUE(Accepts(few));
  Evidence spoilt = few;
  spoilt.score = 0.5F;
  EXPECT_FALSE(Accepts(spoilt));
  EXPECT_FALSE(Accepts(Contradicted(few, 0.2F)));
  spoilt = few;
  spoilt.inliers = 35;
  EXPECT_FALSE(Accepts(spoilt));
}

TEST_F(TrackingMonitorTest, SearchedPose_NeedsMore) {
  Track();
  const Evidence weak_score = With([](Evidence& e) { e.score = 0.70F; });
  const Evidence some_conflict = Contradicted(Good(), 0.16F);
  const Evidence few_inliers = With([](Evidence& e) { e.inliers = 240; });
  for (const Evidence& evidence : {weak_score, some_conflict, few_inliers})
    EXPECT_TRUE(Accepts(evidence));
  Offer(Evidence{});
  EXPECT_TRUE(monitor_.Doubts(stamp_ns_));
  for (const Evidence& evidence : {weak_score, some_conflict, few_inliers})
    EXPECT_FALSE(Accepts(evidence));
  EXPECT_TRUE(Accepts(Good()));
}

TEST_F(TrackingMonitorTest, LongGap_IsDoubtToo) {
  Track();
  EXPECT_FALSE(monitor_.Doubts(stamp_ns_ + kFrameStep_ns));
  EXPECT_TRUE(monitor_.Doubts(stamp_ns_ + 6 * kFrameStep_ns));
  EXPECT_FALSE(
      monitor_.Accepts(With([](Evidence& e) { e.score = 0.7F; }), stamp_ns_ + 6 * kFrameStep_ns));
}

TEST_F(TrackingMonitorTest, TrackingIsClaimed_OnlyWithinEveryBound) {
  for (void (*spoil)(Evidence&) : {
           +[](Evidence& e) { e.score = 0.59F; }, +[](Evidence& e) { e.conflict = 0.16F; },
           +[](Evidence& e) { e.position_std_m = 0.0068F; },  // 3 sigma are 2 cm
           +[](Evidence& e) { e.rotation_std_rad = 0.059F; }  // 3 sigma are 10 degrees
       }) {
    Offer(Good(), 10);
    ASSERT_EQ(monitor_.state(), TrackingState::kTracking);
    Offer(With(spoil));
    EXPECT_EQ(monitor_.state(), TrackingState::kDegraded);
    EXPECT_FALSE(monitor_.Doubts(stamp_ns_));
  }
  Offer(Good());
  EXPECT_EQ(monitor_.state(), TrackingState::kTracking);
}

TEST_F(TrackingMonitorTest, Loss_IsStatedWithinThreeFrames) {
  Track();
  Offer(Evidence{});
  EXPECT_EQ(monitor_.state(), TrackingState::kDegraded);
  Offer(Evidence{});
  EXPECT_EQ(monitor_.state(), TrackingState::kDegraded);
  Offer(Evidence{});
  EXPECT_EQ(monitor_.state(), TrackingState::kLost);
  EXPECT_EQ(monitor_.quality(), 0);
  EXPECT_EQ(monitor_.missed(), 3);
}

TEST_F(TrackingMonitorTest, Quality_FallsBeforeTheTrackIsLost) {
  Track();
  int before = monitor_.quality();
  for (int i = 0; i < 2; ++i) {
    Offer(Evidence{});
    EXPECT_NE(monitor_.state(), TrackingState::kLost);
    EXPECT_LE(monitor_.quality(), before / 2);
    before = monitor_.quality();
  }
}

TEST_F(TrackingMonitorTest, Quality_FallsWithEveryKindOfDoubt) {
  Track();
  const int best = monitor_.quality();
  for (void (*spoil)(Evidence&) :
       {+[](Evidence& e) { e.score = 0.8F; }, +[](Evidence& e) { e.conflict = 0.1F; },
        +[](Evidence& e) { e.position_std_m = 0.003F; },
        +[](Evidence& e) { e.rotation_std_rad = 0.03F; }}) {
    Offer(With(spoil));
    EXPECT_LT(monitor_.quality(), best);
    EXPECT_GT(monitor_.quality(), 0);
  }
  Offer(Good());
  EXPECT_EQ(monitor_.quality(), best);
}

TEST_F(TrackingMonitorTest, FoundAgain_IsRecoveredForAWhile) {
  Track();
  Offer(Evidence{}, 5);
  Offer(Good());
  EXPECT_EQ(monitor_.state(), TrackingState::kRecovered);
  EXPECT_FALSE(monitor_.Doubts(stamp_ns_));
  Offer(Good(), 9);
  EXPECT_EQ(monitor_.state(), TrackingState::kTracking);
}

TEST_F(TrackingMonitorTest, SearchedPose_NeedsWhatWasUsualBeforeTheLoss) {
  // A noisy sensor: half of the points are inliers at best, and a tenth of the model conflicts.
  Evidence usual = Good();
  usual.score = 0.85F;
  usual.conflict = 0.10F;
  usual.inliers = 200;
  const auto found = [&usual](float share) {
    Evidence evidence = usual;
    evidence.score *= share;
    evidence.inliers = static_cast<int>(share * static_cast<float>(usual.inliers));
    return evidence;
  };
  Track();
  Offer(Evidence{}, config_.lost_after_frames);
  EXPECT_FALSE(Accepts(usual)) << "far less than this sensor showed";
  Offer(Good());
  Offer(usual, 100);
  Offer(Evidence{}, config_.lost_after_frames);
  ASSERT_EQ(monitor_.state(), TrackingState::kLost);
  EXPECT_TRUE(Accepts(usual));
  EXPECT_TRUE(Accepts(found(0.8F)));
  EXPECT_FALSE(Accepts(found(0.5F)));
}

TEST_F(TrackingMonitorTest, LookedForInVainForLong_ShouldRestart) {
  Track();
  Offer(InVain(), 40);
  EXPECT_FALSE(monitor_.ShouldRestart());
  Offer(InVain(), 10);
  EXPECT_TRUE(monitor_.ShouldRestart());
  monitor_.Start(config_, stamp_ns_);
  EXPECT_FALSE(monitor_.ShouldRestart());
  EXPECT_EQ(monitor_.state(), TrackingState::kInitialising);
}

TEST_F(TrackingMonitorTest, NothingInView_TheModelIsKept) {
  Track();
  Offer(Evidence{}, 1000);
  EXPECT_EQ(monitor_.state(), TrackingState::kLost);
  EXPECT_EQ(monitor_.searched(), 0);
  EXPECT_FALSE(monitor_.ShouldRestart());
  // Nor does the time before count when something comes into view.
  stamp_ns_ += 100 * kFrameStep_ns;
  Offer(InVain(), 40);
  EXPECT_EQ(monitor_.searched(), 40);
  EXPECT_FALSE(monitor_.ShouldRestart());
}

TEST_F(TrackingMonitorTest, WhatNoFrameAgreedWith_ShouldRestartAsSoonAsItIsLost) {
  for (const Evidence& evidence : {Evidence{}, InVain()}) {
    monitor_.Start(config_, stamp_ns_);
    Offer(evidence, config_.lost_after_frames - 1);
    EXPECT_FALSE(monitor_.ShouldRestart());
    Offer(evidence);
    EXPECT_TRUE(monitor_.ShouldRestart());
  }
}

TEST_F(TrackingMonitorTest, WhatOneFrameAgreedWithOrWasGiven_IsKept) {
  Offer(Good());
  Offer(Evidence{}, 100);
  EXPECT_FALSE(monitor_.ShouldRestart());
  monitor_.Start(config_, stamp_ns_);
  EXPECT_FALSE(monitor_.confirmed());
  monitor_.Confirm();
  Offer(Evidence{}, 100);
  EXPECT_FALSE(monitor_.ShouldRestart());
}

TEST_F(TrackingMonitorTest, ModelOfAPartOfTheFirstFrame_NeedNotExplainMore) {
  const Evidence a_fifth = With([](Evidence& e) {
    e.score = 0.19F;
    e.inliers = e.points / 6;
  });
  EXPECT_FALSE(monitor_.Accepts(a_fifth, stamp_ns_));
  monitor_.Expect(0.2F);
  EXPECT_TRUE(monitor_.Accepts(a_fifth, stamp_ns_));
  EXPECT_FALSE(monitor_.Accepts(With([](Evidence& e) { e.score = 0.1F; }), stamp_ns_));
  // What explains more from then on is what is usual.
  Offer(Good(), 100);
  EXPECT_FALSE(monitor_.Accepts(a_fifth, stamp_ns_));
}

TEST_F(TrackingMonitorTest, PoseThatMayBeAny_IsRecognisedOnlyBeyondDoubt) {
  Track();
  Offer(InVain(), config_.lost_after_frames);
  EXPECT_TRUE(monitor_.Recognises(Good()));
  EXPECT_FALSE(monitor_.Recognises(With([](Evidence& e) { e.registered = false; })));
  EXPECT_FALSE(monitor_.Recognises(With([](Evidence& e) { e.score = 0.92F; })));
  EXPECT_FALSE(monitor_.Recognises(With([](Evidence& e) { e.conflict = 0.04F; })));
  EXPECT_FALSE(monitor_.Recognises(With([](Evidence& e) { e.visible = 0.3F; })));
  EXPECT_FALSE(monitor_.Recognises(With([](Evidence& e) { e.inliers = 200; })));
  EXPECT_FALSE(monitor_.Recognises(With([](Evidence& e) { e.rotation_to_model_std_rad = 0.5F; })));
  EXPECT_FALSE(monitor_.Recognises(With([](Evidence& e) { e.position_to_model_std_m = 0.01F; })));
  EXPECT_TRUE(monitor_.Recognises(With([](Evidence& e) { e.rotation_std_rad = 0.5F; })))
      << "the model has drifted, but this is it"
      << "a mug whose handle is hidden";
}

TEST_F(TrackingMonitorTest, PoseThatIsNearlyRecognised_IsSuspected) {
  Track();
  Offer(InVain(), config_.lost_after_frames);
  // A bottle turned over: most of it is explained, and nothing of it is missing.
  EXPECT_TRUE(monitor_.Suspects(With([](Evidence& e) { e.inliers = 200; })));
  EXPECT_TRUE(monitor_.Suspects(With([](Evidence& e) { e.rotation_to_model_std_rad = 0.5F; })));
  EXPECT_FALSE(monitor_.Suspects(With([](Evidence& e) { e.registered = false; })));
  EXPECT_FALSE(monitor_.Suspects(With([](Evidence& e) { e.score = 0.7F; })));
  EXPECT_FALSE(monitor_.Suspects(With([](Evidence& e) { e.conflict = 0.2F; })));
  EXPECT_FALSE(monitor_.Suspects(With([](Evidence& e) { e.visible = 0.3F; })));
}

TEST_F(TrackingMonitorTest, StampsAtBothEndsOfTime_AreFarApart) {
  constexpr StampNs kFirst_ns = std::numeric_limits<StampNs>::min();
  constexpr StampNs kLast_ns = std::numeric_limits<StampNs>::max();
  monitor_.Start(config_, kFirst_ns);
  monitor_.Confirm();
  EXPECT_FALSE(monitor_.Doubts(kFirst_ns + kFrameStep_ns));
  for (const StampNs stamp_ns : {StampNs{-1}, StampNs{0}, StampNs{1}, kLast_ns})
    EXPECT_TRUE(monitor_.Doubts(stamp_ns)) << stamp_ns;
  for (int i = 0; i < config_.lost_after_frames; ++i) monitor_.Update(InVain(), kFirst_ns);
  EXPECT_FALSE(monitor_.ShouldRestart());
  monitor_.Update(InVain(), kLast_ns);
  EXPECT_TRUE(monitor_.ShouldRestart());
}

TEST(SpanNs, IsTheDifferenceWhereItFitsAndTheFarthestElsewhere) {
  constexpr StampNs kFirst_ns = std::numeric_limits<StampNs>::min();
  constexpr StampNs kLast_ns = std::numeric_limits<StampNs>::max();
  EXPECT_EQ(SpanNs(3, 10), 7);
  EXPECT_EQ(SpanNs(10, 3), -7);
  EXPECT_EQ(SpanNs(0, kLast_ns), kLast_ns);
  EXPECT_EQ(SpanNs(0, kFirst_ns), kFirst_ns);
  EXPECT_EQ(SpanNs(-1, kLast_ns - 1), kLast_ns);
  EXPECT_EQ(SpanNs(-1, kLast_ns), kLast_ns);
  EXPECT_EQ(SpanNs(kFirst_ns, kLast_ns), kLast_ns);
  EXPECT_EQ(SpanNs(kFirst_ns, 0), kLast_ns);
  EXPECT_EQ(SpanNs(1, kFirst_ns), kFirst_ns);
  EXPECT_EQ(SpanNs(kLast_ns, kFirst_ns), kFirst_ns);
  EXPECT_EQ(SpanNs(kFirst_ns, kFirst_ns), 0);
  EXPECT_EQ(SpanNs(kLast_ns, kLast_ns), 0);
}

}  // namespace
}  // namespace disflow
