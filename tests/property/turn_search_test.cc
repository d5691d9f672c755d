// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/turn_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "model_view.h"

namespace disflow::testing {
namespace {

using Search = TurnSearch<profiles::Edge>;

constexpr float kDegree = std::numbers::pi_v<float> / 180.0F;

Transform<Object, Object> AboutZ(float angle_rad) {
  return {Mat3(ExpSo3(Vec3(0.0F, 0.0F, angle_rad))), Vec3::Zero()};
}

Shape Wall() { return Cylinder(0.04F, 0.05F, 0.0015F); }

/// Stands out of the wall where it is turned to.
Shape HandleAt(float angle_rad) {
  const Transform<Object, Object> beside(Mat3::Identity(), Vec3(0.052F, 0.0F, 0.0F));
  return Moved(Moved(Box(Vec3(0.014F, 0.006F, 0.03F), 0.001F), beside), AboutZ(angle_rad));
}

Shape Mug() { return Together(Wall(), HandleAt(0.0F)); }

/// What a camera half a metre away sees of a shape that stands before it, handle to the side.
class SeenFromTheSide {
 public:
  SeenFromTheSide(const Shape& shape, float turn_rad)
      : T_oc_(TurnedAbout(
            axis_, turn_rad,
            PoseCameraFromObject(ExpSo3(Vec3(1.3F, 0.0F, 0.0F)), Vec3(0.02F, -0.01F, 0.5F))
                .Inverse())),
        samples_(SamplesFacing(shape, T_oc_)) {}

  /// The true pose, turned by an angle.
  [[nodiscard]] PoseObjectFromCamera Off(float angle_rad) const {
    return TurnedAbout(axis_, angle_rad, T_oc_);
  }
  [[nodiscard]] Search Look(const EdgeField& model, const PoseObjectFromCamera& T_oc,
                            int part) const {
    return Search(model, config_, samples_, T_oc, axis_, part);
  }
  /// Whether a round about the true pose turned by an angle finds a turn.
  [[nodiscard]] bool FindsATurn(const EdgeField& model, float off_rad) const {
    for (int part = 0; part < Search::kParts; ++part)
      if (Look(model, Off(off_rad), part).Find()) return true;
    return false;
  }
  /// How far from the truth the object is turned after a round that starts at some pose.
  [[nodiscard]] float LeftAfterARound_rad(const EdgeField& model, float off_rad) const {
    PoseObjectFromCamera T_found = Off(off_rad);
    for (int part = 0; part < Search::kParts; ++part) {
      Search search = Look(model, T_found, part);
      if (!search.Find()) continue;
      const PoseObjectFromCamera T_registered = Registered(samples_, model, search.T_found());
      if (search.Confirms(T_registered)) T_found = T_registered;
    }
    return TurnBetween(T_oc_.rotation(), T_found.rotation()).norm();
  }

 private:
  TurnAxis axis_;
  RegistrationConfig config_;
  PoseObjectFromCamera T_oc_;
  Search::Samples samples_;
};

TEST(TurnSearch, HandleSeenFromItsSide_IsFoundWithinARound_HoweverFarItIsTurned) {
  const auto model = MakeModel(Mug());
  for (const float handle_rad : {-0.6F, 0.0F, 0.7F}) {
    const SeenFromTheSide view(Mug(), handle_rad);
    for (int degrees = 30; degrees <= 330; degrees += 25) {
      const float off_rad = static_cast<float>(degrees) * kDegree;
      EXPECT_LT(view.LeftAfterARound_rad(*model, off_rad), 10.0F * kDegree)
          << "handle at " << handle_rad << ", off by " << degrees;
    }
  }
}

TEST(TurnSearch, RightPose_IsKept) {
  const auto model = MakeModel(Mug());
  const SeenFromTheSide view(Mug(), 0.4F);
  EXPECT_FALSE(view.FindsATurn(*model, 0.0F));
}

/// Looks the same from both sides.
Shape Oval() {
  const auto beside = [](float x_m) {
    return Moved(Wall(), Transform<Object, Object>(Mat3::Identity(), Vec3(x_m, 0.0F, 0.0F)));
  };
  return Together(beside(-0.01F), beside(0.01F));
}

TEST(TurnSearch, OvalWithASideThatWasLearntALittleOff_IsNotTurnedOverToTheOther) {
  const auto side = [](float sign) {
    return Seen(Oval(), [=](const Vec3& x_m) { return sign * x_m.y() > 0.0F; });
  };
  for (const float off_m : {0.002F, 0.003F}) {
    const Transform<Object, Object> outwards(Mat3::Identity(), Vec3(0.0F, off_m, 0.0F));
    const auto model = MakeModel(side(-1.0F));
    Counters counters;
    Fuse(Moved(side(1.0F), outwards), Observing{}, 5, *model, counters);
    for (const float turn_rad : {0.0F, std::numbers::pi_v<float>})
      EXPECT_FALSE(SeenFromTheSide(Oval(), turn_rad).FindsATurn(*model, 0.0F))
          << "off by " << off_m << ", seen from " << turn_rad;
  }
}

TEST(TurnSearch, HandleThatWasLearntAgain_WhileTheTurnWasFree_TellsNothing) {
  constexpr float kOff_rad = 100.0F * kDegree;
  const Shape again = HandleAt(kOff_rad);
  const auto left_rad = [&](bool known_to_be_free) {
    const auto model = MakeModel(Mug());
    Counters counters;
    model->SetTurnFree(known_to_be_free);
    Fuse(again, Observing{}, 100, *model, counters);
    return SeenFromTheSide(Mug(), 0.0F).LeftAfterARound_rad(*model, kOff_rad);
  };
  EXPECT_LT(left_rad(true), 10.0F * kDegree);
  EXPECT_NEAR(left_rad(false), kOff_rad, 10.0F * kDegree);
}

TEST(TurnSearch, NothingOnTheWall_FindsNoTurn) {
  const auto model = MakeModel(Wall());
  const SeenFromTheSide view(Wall(), 0.0F);
  EXPECT_FALSE(view.FindsATurn(*model, 0.7F));
}

TEST(TurnSearch, ObjectWithCorners_IsLeftToItsSlopes) {
  const Shape box = Box(Vec3(0.05F, 0.03F, 0.04F), 0.0015F);
  const auto model = MakeModel(box);
  const SeenFromTheSide view(box, 0.3F);
  for (int degrees = 20; degrees <= 90; degrees += 10)
    EXPECT_FALSE(view.FindsATurn(*model, static_cast<float>(degrees) * kDegree)) << degrees;
}

TEST(TurnSearch, NoSampleAndNoModel_FindNoTurn) {
  const auto empty = std::make_unique<EdgeField>();
  empty->Start(FieldConfig{});
  const SeenFromTheSide view(Mug(), 0.0F);
  EXPECT_FALSE(view.Look(*empty, view.Off(1.0F), 0).Find());
  const auto model = MakeModel(Mug());
  const RegistrationConfig config;
  EXPECT_FALSE(Search(*model, config, Search::Samples{}, view.Off(1.0F), TurnAxis{}, 0).Find());
}

}  // namespace
}  // namespace disflow::testing
