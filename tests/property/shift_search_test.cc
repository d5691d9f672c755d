// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/shift_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "model_view.h"

namespace disflow::testing {
namespace {

using Search = ShiftSearch<profiles::Edge>;

constexpr float kStep_m = 0.005F;
constexpr int kParts = 4;  // as far as 0.12 m either way

Shape Beam() { return Box(Vec3(0.1F, 0.03F, 0.02F), 0.0015F); }

/// What a camera half a metre away sees of a beam, one end turned to it.
class SeenFromItsEnd {
 public:
  SeenFromItsEnd()
      : T_oc_(PoseCameraFromObject(ExpSo3(Vec3(0.3F, 0.7F, 0.2F)), Vec3(0.02F, -0.01F, 0.5F))
                  .Inverse()),
        samples_(SamplesFacing(Beam(), T_oc_)) {}

  /// How far along the beam the pose is off after all parts of a search.
  [[nodiscard]] float LeftAfterASearch_m(const EdgeField& model, float off_m) const {
    PoseObjectFromCamera T_found(T_oc_.rotation(),
                                 Vec3(T_oc_.translation() + off_m * Vec3::UnitX()));
    for (int part = 0; part < kParts; ++part) {
      Search search(model, no_model_edges_, config_, samples_, no_edges_, T_found,
                    {Vec3::UnitX(), kStep_m, part});
      if (!search.Find()) continue;
      const PoseObjectFromCamera T_registered = Registered(samples_, model, search.T_found());
      if (!search.Confirms(T_registered)) continue;
      T_found = T_registered;
      break;  // what was found is followed
    }
    return T_found.translation().x() - T_oc_.translation().x();
  }

 private:
  RegistrationConfig config_;
  PoseObjectFromCamera T_oc_;
  Search::Samples samples_;
  Search::Edges no_edges_;
  Search::Model no_model_edges_{};
};

TEST(ShiftSearch, EndInView_IsFoundHoweverFarTheBeamHasSlid) {
  const auto model = MakeModel(Beam());
  const SeenFromItsEnd view;
  for (int mm = -100; mm <= 100; mm += 17) {
    const float off_m = 1e-3F * static_cast<float>(mm);
    if (std::abs(mm) < 12) continue;  // which registration reaches
    EXPECT_NEAR(view.LeftAfterASearch_m(*model, off_m), 0.0F, 1e-3F) << "off by " << mm << " mm";
  }
}

TEST(ShiftSearch, RightPlace_IsKept) {
  const auto model = MakeModel(Beam());
  EXPECT_EQ(SeenFromItsEnd().LeftAfterASearch_m(*model, 0.0F), 0.0F);
}

// What was learnt at a place that may be wrong would confirm itself.
TEST(ShiftSearch, EndThatWasLearntSinceItSlid_TellsNothing) {
  auto model = std::make_unique<EdgeField>();
  model->Start(FieldConfig{});
  Counters counters;
  model->SetShiftFree(true);
  Fuse(Beam(), Observing{}, 1, *model, counters);
  constexpr float kOff_m = 0.04F;
  const SeenFromItsEnd view;
  EXPECT_FLOAT_EQ(view.LeftAfterASearch_m(*model, kOff_m), kOff_m);
  model->SetShiftFree(false);
  EXPECT_NEAR(view.LeftAfterASearch_m(*model, kOff_m), 0.0F, 1e-3F);
}

// Neither end is in view.
TEST(ShiftSearch, SidesAlone_TellNothing) {
  const auto model =
      MakeModel(Seen(Beam(), [](const Vec3& x_m) { return std::abs(x_m.x()) < 0.09F; }));
  constexpr float kOff_m = 0.03F;
  const SeenFromItsEnd view;
  EXPECT_FLOAT_EQ(view.LeftAfterASearch_m(*model, kOff_m), kOff_m);
}

}  // namespace
}  // namespace disflow::testing
