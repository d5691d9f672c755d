// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "disflow/flow/kernel_width.h"
#include "disflow/flow/registration.h"
#include "disflow/flow/registration_impl.h"
#include "model_builder.h"

namespace disflow::testing {
namespace {

/// A box of which three sides are seen through noise of 2 mm, whose model is exact.
class NoisyBox : public ::testing::Test {
 protected:
  using Registered = Registration<profiles::Edge>;
  static constexpr int kTrials = 120;
  static constexpr float kNoise_m = 0.002F;

  NoisyBox()
      : shape_(Box(Vec3(0.06F, 0.04F, 0.08F), 0.0015F)),
        model_(MakeModel(shape_)),
        T_oc_(PoseCameraFromObject(ExpSo3(Vec3(0.4F, 0.7F, -0.2F)), Vec3(0.05F, -0.02F, 0.6F))
                  .Inverse()) {
    edges_.Start();
  }

  /// What is seen of it, farther from the surface by `excess` than its noise is said to be.
  void Observe(float excess, std::mt19937& random) {
    const Vec3& eye_o = T_oc_.translation();
    samples_.clear();
    while (samples_.size() < 200) {
      const SurfacePoint point = shape_.random_point(random);
      const Vec3 ray = eye_o - point.position_m;
      if (point.normal.dot(ray) < 0.3F * ray.norm()) continue;
      const Observing observing{.noise_m = excess * kNoise_m};
      SurfaceSample sample = testing::Observe(point, observing, random);
      sample.position_m = T_oc_.Inverse() * sample.position_m;
      sample.normal = T_oc_.rotation().transpose() * sample.normal;
      sample.variance_m2 = kNoise_m * kNoise_m;
      (void)samples_.push_back(sample);
    }
  }
  [[nodiscard]] RegistrationResult Align(const KernelWidth& width) {
    registration_->SetKernel(width);
    registration_->SetObservations(samples_, no_edges_);
    return registration_->Align(*model_, edges_, config_, T_oc_, T_oc_, {0.005F, 0.0F},
                                {config_.iterations});
  }
  /// Mean square of how far the box's place is off, in many frames.
  [[nodiscard]] double MeanSquareError(const KernelWidth& width) {
    std::mt19937 random(3);
    double sum = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      Observe(1.0F, random);
      const RegistrationResult found = Align(width);
      EXPECT_TRUE(found.solved);
      const Vec3 off_m = found.T_oc.Inverse().translation() - T_oc_.Inverse().translation();
      sum += static_cast<double>(off_m.squaredNorm());
    }
    return sum / kTrials;
  }
  [[nodiscard]] float MeanSpread(float excess) {
    std::mt19937 random(5);
    float sum = 0.0F;
    constexpr int kFrames = 20;
    for (int frame = 0; frame < kFrames; ++frame) {
      Observe(excess, random);
      sum += Align({}).spread;
    }
    return sum / kFrames;
  }

  Shape shape_;
  std::unique_ptr<EdgeField> model_;
  PoseObjectFromCamera T_oc_;
  FixedVector<SurfaceSample, 200> samples_;
  Registered::Edges no_edges_;
  Registered::Model edges_;
  RegistrationConfig config_{.temporal_std_m = 1.0F, .temporal_std_rad = 1.0F};
  std::unique_ptr<Registered> registration_ = std::make_unique<Registered>();
};

TEST_F(NoisyBox, SpreadOfResiduals_IsThatOfTheNoise) {
  EXPECT_NEAR(MeanSpread(0.5F), 0.5F, 0.08F);
  EXPECT_NEAR(MeanSpread(1.0F), 1.0F, 0.12F);
}

TEST_F(NoisyBox, WithAKernelLearntFromIt_IsFoundMoreExactly) {
  KernelWidth learnt;
  std::mt19937 random(1);
  for (int frame = 0; frame < 50; ++frame) {
    Observe(1.0F, random);
    const RegistrationResult found = Align(learnt);
    learnt.Learn(found.spread);
  }
  EXPECT_LT(MeanSquareError(learnt), 0.75 * MeanSquareError({}));
}

}  // namespace
}  // namespace disflow::testing
