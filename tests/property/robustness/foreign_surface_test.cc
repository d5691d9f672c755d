// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "disflow/host/simulated_shapes.h"
#include "tracked_sequence.h"

namespace disflow::testing {
namespace {

using host::Vec3d;

// Noise, drift and rounded edges of the model, and the gaps between the true surface's points.
constexpr double kNear_m = 0.005;
constexpr int kTruePoints = 20000;
// A bottle's turn about its axis is known to about a degree.
constexpr double kBottlesTurn_deg = 1.5;

class ForeignSurface : public ::testing::Test {
 protected:
  void Track(const host::SimulationOptions& options, const Config& config = {}) {
    sequence = std::make_unique<TrackedSequence>(options, config);
    sequence->Run(options.frames);
    surface_ = host::SampleSurface(sequence->simulation().mesh(), kTruePoints);
  }
  /// Share of the model's samples that are not on the object.
  [[nodiscard]] double FalseShare() const {
    const auto T_true = sequence->T_true();
    int all = 0;
    int off = 0;
    sequence->tracker().field().store().ForEach([&](auto, const auto& cluster) {
      for (const auto& sample : cluster.samples) {
        ++all;
        const Vec3d x_m = T_true * Vec3d(sample.position_m.template cast<double>());
        off += Distance(x_m) > kNear_m ? 1 : 0;
      }
    });
    EXPECT_GT(all, 500);
    return static_cast<double>(off) / all;
  }
  /// Largest distance of the last frame's samples from the object.
  [[nodiscard]] double FarthestSample() const {
    const auto T_oc = sequence->Truth(sequence->last().index).object.pose.Inverse();
    double farthest_m = 0.0;
    for (const SurfaceSample& sample : sequence->tracker().last_samples()) {
      const Vec3d x_m = T_oc * Vec3d(sample.position_m.cast<double>());
      farthest_m = std::max(farthest_m, Distance(x_m));
    }
    return farthest_m;
  }
  /// Of the last frame's samples, camera frame.
  [[nodiscard]] Vec3 MeanOfSamples() const {
    Vec3 sum = Vec3::Zero();
    const auto& samples = sequence->tracker().last_samples();
    for (const SurfaceSample& sample : samples) sum += sample.position_m;
    return sum / static_cast<float>(std::max(static_cast<int>(samples.size()), 1));
  }
  [[nodiscard]] static host::SimulationOptions Box(int frames) {
    return Scene(host::ObjectKind::kBox, frames);
  }
  void ExpectGoodTrack(double most_deg = 1.0) const {
    EXPECT_EQ(sequence->last().estimate.state, TrackingState::kTracking);
    EXPECT_EQ(sequence->last().estimate.reset_counter, 0);
    EXPECT_LT(sequence->last().off_m, 0.003);
    EXPECT_LT(sequence->last().off_deg, most_deg);
    EXPECT_LE(sequence->LongestLie(), 3);
  }

  void ExpectOnlyTheFastBox(host::MaskKind mask) {
    host::SimulationOptions options = Box(50);
    options.mask = mask;
    options.motion = host::MotionKind::kFast;
    Track(options);
    ExpectGoodTrack();
    EXPECT_LT(FalseShare(), 0.002);
  }

  /// The bottle without a mask, and a hand that touches it in frame 30 and then moves along with it
  /// as if it were a part.
  [[nodiscard]] static host::SimulationOptions TouchedBottle(
      host::MaskKind mask = host::MaskKind::kNone) {
    host::SimulationOptions options = Scene(host::ObjectKind::kBottle, 65);
    options.occluder = host::OccluderKind::kHand;
    options.mask = mask;
    return options;
  }

  std::unique_ptr<TrackedSequence> sequence;

 private:
  [[nodiscard]] double Distance(const Vec3d& x_m) const {
    double squared_m2 = 1.0;
    for (const Vec3d& point : surface_)
      squared_m2 = std::min(squared_m2, (point - x_m).squaredNorm());
    return std::sqrt(squared_m2);
  }
  std::vector<Vec3d> surface_;
};

TEST_F(ForeignSurface, ArmThatIsNearerFromTheFirstImageOn_IsNotTakenForTheObject) {
  host::SimulationOptions options = Box(60);
  options.occluder = host::OccluderKind::kArm;
  options.mask = host::MaskKind::kNone;
  options.motion = host::MotionKind::kFast;
  Track(options);
  ExpectGoodTrack();
  EXPECT_LT(FalseShare(), 0.006);
}

TEST_F(ForeignSurface, TouchingHand_DoesNotBecomePartOfTheObject) {
  Track(TouchedBottle());
  ExpectGoodTrack(kBottlesTurn_deg);
  EXPECT_LT(FalseShare(), 0.006);  // where it touches, the two cannot be told apart
}

TEST_F(ForeignSurface, TouchingHand_IsCutOffEvenWithoutTheMemoryOfFreeSpace) {
  Config config;
  config.segmenter.free_margin_m = 0.0F;
  Track(TouchedBottle(), config);
  EXPECT_LT(FalseShare(), 0.006);
}

TEST_F(ForeignSurface, TouchingHandThatAMaskTakesIn_DoesNotBecomePartOfTheObject) {
  Track(TouchedBottle(host::MaskKind::kLeaking));
  ExpectGoodTrack(kBottlesTurn_deg);
  EXPECT_LT(FalseShare(), 0.02);  // such a mask lets in more than the hand
}

// So that the test above tests something: under a mask nothing is cut.
TEST_F(ForeignSurface, WithoutTheMemoryOfFreeSpace_TheHandInTheMaskWouldBecomePart) {
  Config config;
  config.segmenter.free_margin_m = 0.0F;
  Track(TouchedBottle(host::MaskKind::kLeaking), config);
  EXPECT_GT(FalseShare(), 0.06);
}

// Grown and shrunk by 6 pixels in turn, each held for three frames.
TEST_F(ForeignSurface, SloppyLateMask_LetsNothingElseIn) {
  ExpectOnlyTheFastBox(host::MaskKind::kSloppy);
}

TEST_F(ForeignSurface, NoMask_LetsNothingElseIn) { ExpectOnlyTheFastBox(host::MaskKind::kNone); }

/// The box on a table, without a mask.
class FirstFrameOnTable : public ForeignSurface {
 protected:
  FirstFrameOnTable() : options_(Box(45)) {
    options_.support = host::SupportKind::kTable;
    options_.mask = host::MaskKind::kNone;
  }
  [[nodiscard]] Vec2 CenterPx() const {
    const host::Simulation simulation(options_, host::MakeObjectMesh(options_.object));
    const Vec3d center = simulation.TruthAt(0).object.pose.translation();
    return simulation.camera().Project(center.cast<float>());
  }
  /// Tracked from the first frame on, while it stands and after it was lifted off.
  void ExpectOnlyTheBox(const Config& config) {
    host::SimulationOptions first = options_;
    first.frames = 1;
    Track(first, config);
    EXPECT_EQ(sequence->last().estimate.status, Status::kOk);
    EXPECT_GT(sequence->last().estimate.samples, 300);
    EXPECT_LT(FarthestSample(), 0.008);
    Track(options_, config);
    ExpectGoodTrack();
    EXPECT_LT(FalseShare(), 0.003);
  }

  host::SimulationOptions options_;
  Config config_;
};

TEST_F(FirstFrameOnTable, RangeGate_FindsTheObject) {
  config_.segmenter.max_range_m = 1.0F;
  ExpectOnlyTheBox(config_);
}

TEST_F(FirstFrameOnTable, RegionOfInterest_FindsTheObject) {
  const Vec2 center_px = CenterPx();
  config_.segmenter.roi_width_px = 260;
  config_.segmenter.roi_height_px = 240;
  config_.segmenter.roi_x_px = std::max(static_cast<int>(center_px.x()) - 130, 0);
  config_.segmenter.roi_y_px = std::max(static_cast<int>(center_px.y()) - 120, 0);
  ExpectOnlyTheBox(config_);
}

TEST_F(FirstFrameOnTable, SeedPixel_FindsTheObject) {
  const Vec2 center_px = CenterPx();
  config_.segmenter.seed_u_px = static_cast<int>(center_px.x());
  config_.segmenter.seed_v_px = static_cast<int>(center_px.y());
  ExpectOnlyTheBox(config_);
}

// A time-of-flight camera's noise leaves pieces of the table, some nearer than what stands on it,
// and fills the memory of runs before the image's lower half is reached.
TEST_F(FirstFrameOnTable, BeforeNoise_TheWholeThingIsFoundAndNothingElse) {
  options_.noise = host::NoiseKind::kTof;
  options_.motion = host::MotionKind::kFast;
  options_.frames = 1;
  for (const auto object :
       {host::ObjectKind::kBox, host::ObjectKind::kBottle, host::ObjectKind::kSprayBottle}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      options_.object = object;
      options_.seed = seed;
      options_.mask = host::MaskKind::kGt;
      Track(options_);
      const Vec3 masked_m = MeanOfSamples();
      options_.mask = host::MaskKind::kNone;
      Track(options_);
      EXPECT_LT((MeanOfSamples() - masked_m).norm(), 0.01F)
          << "object " << static_cast<int>(object) << ", " << seed;
    }
  }
}

}  // namespace
}  // namespace disflow::testing
