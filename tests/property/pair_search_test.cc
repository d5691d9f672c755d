// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/pair_search.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "model_view.h"

namespace disflow::testing {
namespace {

using Pairs = PairSearch<profiles::Edge>;
using PairSamples = Registration<profiles::Edge>::Samples;

/// A board with a post on its end: from hardly anywhere does it look as from elsewhere.
Shape Post() {
  const Transform<Object, Object> on_top(Mat3::Identity(), Vec3(0.0F, 0.01F, 0.075F));
  return Together(Box(Vec3(0.02F, 0.035F, 0.05F), 0.0015F),
                  Moved(Cylinder(0.012F, 0.03F, 0.0015F), on_top));
}

/// Anywhere before the camera, turned anyhow.
class AnyPlace {
 public:
  PoseObjectFromCamera operator()() {
    std::normal_distribution<float> any;
    Eigen::Vector4f turn;
    for (int i = 0; i < 4; ++i) turn(i) = any(random_);
    const Mat3 rotation = Eigen::Quaternionf(Eigen::Vector4f(turn.normalized())).toRotationMatrix();
    const float x_m = Uniform(random_, -0.2F, 0.2F);
    return PoseCameraFromObject(rotation, Vec3(x_m, 0.1F, Uniform(random_, 0.5F, 0.8F))).Inverse();
  }

 private:
  std::mt19937 random_{3};
};

bool IsAt(const PoseObjectFromCamera& T_true, const PoseObjectFromCamera& T_oc) {
  return TurnBetween(T_true.rotation(), T_oc.rotation()).norm() < 0.02F &&
         (T_oc.Inverse().translation() - T_true.Inverse().translation()).norm() < 0.003F;
}

TEST(PairSearch, WhereverItIs_OneOfThePosesOfAFewFramesLeadsToTheRightOne) {
  const auto model = MakeModel(Post());
  const RegistrationConfig config;
  AnyPlace any;
  constexpr int kPlaces = 60;
  constexpr int kFrames = 8;
  int found = 0;
  for (int place = 0; place < kPlaces; ++place) {
    const PoseObjectFromCamera T_true = any();
    const PairSamples samples = SamplesFacing(Post(), T_true);
    bool found_here = false;
    for (int part = 0; part < kFrames && !found_here; ++part) {
      Pairs search(*model, config, samples, 10 * place + part);
      search.Find();
      for (int i = 0; i < search.size() && !found_here; ++i) {
        found_here = IsAt(T_true, Registered(samples, *model, search.T_oc(i)));
      }
    }
    found += found_here ? 1 : 0;
  }
  EXPECT_GE(found, kPlaces * 9 / 10);
}

TEST(PairSearch, SamePart_GivesTheSamePoses_AndAnotherOthers) {
  const auto model = MakeModel(Post());
  const PairSamples samples = SamplesFacing(Post(), AnyPlace()());
  const RegistrationConfig config;
  const auto poses = [&](int part) {
    Pairs search(*model, config, samples, part);
    search.Find();
    return search;
  };
  const Pairs once = poses(Pairs::kParts - 1);
  const Pairs twice = poses(Pairs::kParts - 1);
  const Pairs other = poses(0);
  ASSERT_EQ(once.size(), Pairs::kPoses);
  ASSERT_EQ(twice.size(), once.size());
  for (int i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once.T_oc(i).rotation(), twice.T_oc(i).rotation());
    EXPECT_NE(once.T_oc(i).rotation(), other.T_oc(i).rotation());
  }
}

TEST(PairSearch, NothingSeenOrNothingKnown_GivesNoPose) {
  const auto model = MakeModel(Post());
  const RegistrationConfig config;
  const PairSamples nothing;
  Pairs of_nothing(*model, config, nothing, 0);
  of_nothing.Find();
  EXPECT_EQ(of_nothing.size(), 0);

  const auto empty = std::make_unique<EdgeField>();
  empty->Start({});
  const PairSamples samples = SamplesFacing(Post(), AnyPlace()());
  Pairs in_nothing(*empty, config, samples, 0);
  in_nothing.Find();
  EXPECT_EQ(in_nothing.size(), 0);
}

// All of it seen at one place: no pair tells a pose.
TEST(PairSearch, SamplesAtOnePlace_GiveNoPose) {
  const auto model = MakeModel(Post());
  const RegistrationConfig config;
  PairSamples samples = SamplesFacing(Post(), AnyPlace()());
  for (SurfaceSample& sample : samples) sample = samples[0];
  Pairs search(*model, config, samples, 0);
  search.Find();
  EXPECT_EQ(search.size(), 0);
}

}  // namespace
}  // namespace disflow::testing
