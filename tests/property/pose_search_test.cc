// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/pose_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "model_builder.h"

namespace disflow::testing {
namespace {

using Search = PoseSearch<profiles::Edge>;
using EdgeRegistration = Registration<profiles::Edge>;

/// A box of which three sides are seen.
class LostBox : public ::testing::Test {
 protected:
  LostBox()
      : shape_(Box(Vec3(0.06F, 0.04F, 0.08F), 0.0015F)),
        model_(MakeModel(shape_)),
        T_oc_(PoseCameraFromObject(ExpSo3(Vec3(0.4F, 0.7F, -0.2F)), Vec3(0.05F, -0.02F, 0.6F))
                  .Inverse()) {
    edges_.Start();
    const Observing observing;
    std::mt19937 random(7);
    const Vec3& eye_o = T_oc_.translation();
    while (samples_.size() < Search::kPoints) {
      const SurfacePoint point = shape_.random_point(random);
      if (point.normal.dot(eye_o - point.position_m) < 0.3F * (eye_o - point.position_m).norm())
        continue;
      SurfaceSample sample = Observe(point, observing, random);
      sample.position_m = T_oc_.Inverse() * sample.position_m;
      sample.normal = T_oc_.rotation().transpose() * sample.normal;
      (void)samples_.push_back(sample);
    }
    registration_->SetObservations(samples_, no_edges_);
  }

  /// The true pose, turned about the object's middle and moved, object axes.
  [[nodiscard]] PoseObjectFromCamera Off(const Vec3& turn_rad, const Vec3& shift_m) const {
    return {Mat3(ExpSo3(turn_rad) * T_oc_.rotation()),
            Vec3(ExpSo3(turn_rad) * T_oc_.translation() + shift_m)};
  }
  [[nodiscard]] Search::Start Find(const PoseObjectFromCamera& T_predicted, int search) const {
    return Search(*registration_, *model_, edges_, config_,
                  {T_predicted, T_predicted, true, search})
        .Find([](const PoseObjectFromCamera&) { return 0.0F; });
  }
  /// Of an object that was followed until now.
  template <class Conflict>
  [[nodiscard]] Search::Start FindFollowed(const PoseObjectFromCamera& T_followed,
                                           bool contradicted, bool unheld,
                                           const Conflict& conflict) const {
    const PoseSearchPrior prior{.T_predicted = T_followed,
                                .T_previous = T_followed,
                                .velocity_known = true,
                                .contradicted = contradicted,
                                .unheld = unheld};
    return Search(*registration_, *model_, edges_, config_, prior).Find(conflict);
  }
  /// Whether what the search starts from leads to the true pose.
  [[nodiscard]] bool Finds(const PoseObjectFromCamera& T_predicted, int search) const {
    const Search::Start start = Find(T_predicted, search);
    EXPECT_LE(start.tried, Search::kMaxStarts + 1);
    const auto aligned =
        registration_->Align(*model_, edges_, config_, start.T_oc, start.T_expected,
                             start.robust_scale, {config_.iterations, start.held});
    return TurnBetween(T_oc_.rotation(), aligned.T_oc.rotation()).norm() < 0.02F &&
           (aligned.T_oc.Inverse().translation() - T_oc_.Inverse().translation()).norm() < 0.003F;
  }

  Shape shape_;
  std::unique_ptr<EdgeField> model_;
  PoseObjectFromCamera T_oc_;
  FixedVector<SurfaceSample, Search::kPoints> samples_;
  EdgeRegistration::Edges no_edges_;
  EdgeRegistration::Model edges_;
  RegistrationConfig config_;
  std::unique_ptr<EdgeRegistration> registration_ = std::make_unique<EdgeRegistration>();
};

TEST_F(LostBox, GoodPrediction_IsTakenAsItIs) {
  const Search::Start start = Find(T_oc_, 0);
  EXPECT_EQ(start.tried, 1);
}

TEST_F(LostBox, WithinThirtyDegreesAndFiveCentimetres_IsFoundWithinTheGridsRound) {
  constexpr float kTurn_rad = 30.0F * 3.14159265F / 180.0F;
  constexpr float kShift_m = 0.05F;
  constexpr int kRound = 4;  // frames until every direction was tried
  std::mt19937 random(11);
  std::normal_distribution<float> gaussian;
  const auto direction = [&] {
    return Vec3(gaussian(random), gaussian(random), gaussian(random)).normalized();
  };
  constexpr int kTries = 60;
  int found = 0;
  for (int i = 0; i < kTries; ++i) {
    const PoseObjectFromCamera T_off =
        Off(Vec3(kTurn_rad * direction()), Vec3(kShift_m * direction()));
    bool found_now = false;
    for (int search = 1; search <= kRound && !found_now; ++search) found_now = Finds(T_off, search);
    found += found_now ? 1 : 0;
  }
  EXPECT_GE(found, kTries * 95 / 100);
}

TEST_F(LostBox, FollowingAlone_WouldNotReachAsFar) {
  std::mt19937 random(11);
  std::normal_distribution<float> gaussian;
  constexpr int kTries = 60;
  int found = 0;
  for (int i = 0; i < kTries; ++i) {
    const Vec3 axis = Vec3(gaussian(random), gaussian(random), gaussian(random)).normalized();
    found += Finds(Off(Vec3(0.52F * axis), Vec3::Zero()), 0) ? 1 : 0;
  }
  EXPECT_LT(found, kTries * 9 / 10);
}

TEST_F(LostBox, IsNotTurned_BecauseNothingHeldIt) {
  const PoseObjectFromCamera T_turned = Off(Vec3(0.0F, 0.0F, 0.05F), Vec3::Zero());
  const auto left_rad = [&](bool contradicted, bool unheld) {
    const Search::Start start = FindFollowed(T_turned, contradicted, unheld,
                                             [](const PoseObjectFromCamera&) { return 0.0F; });
    return TurnBetween(T_oc_.rotation(), start.T_oc.rotation()).norm();
  };
  EXPECT_LT(left_rad(true, false), 0.01F);
  EXPECT_NEAR(left_rad(false, true), 0.05F, 1e-4F);
}

/// A board of which one face is seen: it slides without a sample that minds.
class SlidBoard : public LostBox {
 protected:
  SlidBoard() {
    model_ = MakeModel(board_);
    samples_.clear();
    const Observing observing;
    std::mt19937 random(7);
    while (samples_.size() < Search::kPoints) {
      const SurfacePoint point = board_.random_point(random);
      if (point.normal.z() > -0.5F) continue;
      SurfaceSample sample = Observe(point, observing, random);
      sample.position_m += kCenter_c;
      (void)samples_.push_back(sample);
    }
    registration_->SetObservations(samples_, no_edges_);
  }
  /// How far from its place a board that was followed 4 cm beside it is looked for.
  [[nodiscard]] float FoundBeside_m(bool contradicted, bool unheld) const {
    const PoseObjectFromCamera T_slid =
        PoseCameraFromObject(Mat3::Identity(), kCenter_c + Vec3(0.04F, 0.0F, 0.0F)).Inverse();
    const auto conflict = [&](const PoseObjectFromCamera& T_oc) {
      int there = 0;
      int contradicting = 0;
      model_->store().ForEach([&](Handle, const auto& cluster) {
        const Vec3 x_o = T_oc.Inverse() * cluster.centroid_m - kCenter_c;
        ++(board_.distance_m(x_o) < 0.01F ? there : contradicting);
      });
      return static_cast<float>(contradicting) / static_cast<float>(there + contradicting);
    };
    const Search::Start start = FindFollowed(T_slid, contradicted, unheld, conflict);
    return (start.T_oc.Inverse().translation() - kCenter_c).norm();
  }

 private:
  static inline const Vec3 kCenter_c{0.0F, 0.0F, 0.5F};
  Shape board_ = Box(Vec3(0.08F, 0.05F, 0.004F), 0.0F);
};

TEST_F(SlidBoard, IsLookedFor_WhenItsModelClaimsWhatIsNotThere) {
  EXPECT_GT(FoundBeside_m(false, false), 0.035F);
  EXPECT_LT(FoundBeside_m(true, false), 0.005F);
}

TEST_F(SlidBoard, IsLookedFor_WhenNothingHeldIt) { EXPECT_LT(FoundBeside_m(false, true), 0.005F); }

}  // namespace
}  // namespace disflow::testing
