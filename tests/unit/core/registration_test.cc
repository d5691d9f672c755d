// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "disflow/flow/registration_impl.h"
#include "model_builder.h"

namespace disflow::testing {
namespace {

using EdgeRegistration = Registration<profiles::Edge>;
using Samples = EdgeRegistration::Samples;
constexpr float kDegree_rad = 3.14159265F / 180.0F;
constexpr float kNoise_m = 3e-4F;

/// Two cylinders about one axis, which is not the octree's: a body and a neck.
Shape Bottle() {
  constexpr float kBody_m = 0.03F;
  constexpr float kBodyHalf_m = 0.045F;
  constexpr float kNeck_m = 0.012F;
  constexpr float kNeckHalf_m = 0.02F;
  const Vec3 up_m(0.0F, 0.0F, kBodyHalf_m + kNeckHalf_m);
  const Shape body = Cylinder(kBody_m, kBodyHalf_m, 0.0015F);
  const Shape neck = Moved(Cylinder(kNeck_m, kNeckHalf_m, 0.0015F),
                           Transform<Object, Object>(Mat3(Mat3::Identity()), up_m));
  const Shape bottle{
      [=](const Vec3& x_m) { return std::min(body.distance_m(x_m), neck.distance_m(x_m)); },
      [=](std::mt19937& random) {
        constexpr float kInside_m = 1e-3F;
        for (;;) {
          const bool of_neck = Uniform(random, 0.0F, body.area_m2 + neck.area_m2) < neck.area_m2;
          const SurfacePoint point = (of_neck ? neck : body).random_point(random);
          if ((of_neck ? body : neck).distance_m(point.position_m) > kInside_m) return point;
        }
      },
      body.area_m2 + neck.area_m2};
  return Moved(bottle, OddPlace());
}

/// A model of a shape, and what a camera sees of that shape.
class Seen {
 public:
  /// @param T_co The true pose.
  /// @param model_noise The model is made of observations this good.
  Seen(const Shape& shape, const PoseCameraFromObject& T_co, const Observing& model_noise = {})
      : shape_(shape), T_oc_(T_co.Inverse()), model_(MakeModel(shape, model_noise)) {
    edges_.Start();
    config_.temporal_std_m = 1.0F;  // the surface alone decides
    config_.temporal_std_rad = 10.0F;
  }

  /// @param unstated_tilt_rad Noise of the normals, per component, that the samples do not state.
  void Look(unsigned seed, float noise_m = kNoise_m, float unstated_tilt_rad = 0.0F) {
    Observing observing;
    observing.noise_m = noise_m;
    observing.normal_noise = 0.02F;
    std::mt19937 random(seed);
    samples_.clear();
    for (int tries = 0; tries < 100000 && !samples_.full(); ++tries) {
      const SurfacePoint point = shape_.random_point(random);
      const Vec3 to_eye_m = T_oc_.translation() - point.position_m;
      if (point.normal.dot(to_eye_m) < 0.3F * to_eye_m.norm()) continue;
      SurfaceSample sample = Observe(point, observing, random);
      std::normal_distribution<float> tilt(0.0F, std::max(unstated_tilt_rad, 1e-9F));
      const Vec3 tilted = sample.normal + Vec3(tilt(random), tilt(random), tilt(random));
      sample.normal = tilted.normalized();
      sample.position_m = T_oc_.Inverse() * sample.position_m;
      sample.normal = T_oc_.rotation().transpose() * sample.normal;
      (void)samples_.push_back(sample);
    }
    EXPECT_TRUE(samples_.full()) << "the shape turns its back on the camera";
    registration_->SetObservations(samples_, no_edges_);
  }

  /// Turned about the middle of what is seen, and shifted. Object axes.
  [[nodiscard]] PoseObjectFromCamera Off(const Vec6& xi) const {
    const Vec3 center_m = T_oc_ * registration_->center_c();
    const Mat3 turn = ExpSo3(Vec3(xi.tail<3>()));
    return {Mat3(turn * T_oc_.rotation()),
            Vec3(turn * (T_oc_.translation() - center_m) + center_m + xi.head<3>())};
  }
  /// The inverse of Off().
  [[nodiscard]] Vec6 ErrorOf(const PoseObjectFromCamera& T_oc) const {
    Vec6 error;
    error.head<3>() = T_oc * registration_->center_c() - T_oc_ * registration_->center_c();
    error.tail<3>() = TurnBetween(T_oc_.rotation(), T_oc.rotation());
    return error;
  }
  [[nodiscard]] EdgeRegistration::Result Align(const PoseObjectFromCamera& T_start,
                                               StepLimit steps = {20}) const {
    return registration_->Align(*model_, edges_, config_, T_start, T_start, {0.01F, 0.003F}, steps);
  }
  [[nodiscard]] float Score(const PoseObjectFromCamera& T_oc) const {
    return registration_->Score(*model_, config_, T_oc);
  }
  /// What the surface does not tell is taken from the prediction, as in the tracker.
  void TrustPrediction() {
    config_.temporal_std_m = RegistrationConfig{}.temporal_std_m;
    config_.temporal_std_rad = RegistrationConfig{}.temporal_std_rad;
  }
  [[nodiscard]] const EdgeField& model() const { return *model_; }
  [[nodiscard]] const PoseObjectFromCamera& T_oc() const { return T_oc_; }
  [[nodiscard]] RegistrationConfig& config() { return config_; }
  [[nodiscard]] EdgeRegistration& registration() { return *registration_; }
  [[nodiscard]] EdgeRegistration::Model& edges() { return edges_; }

 private:
  Shape shape_;
  PoseObjectFromCamera T_oc_;
  std::unique_ptr<EdgeField> model_;
  EdgeRegistration::Edges no_edges_;
  EdgeRegistration::Model edges_;
  RegistrationConfig config_;
  Samples samples_;
  std::unique_ptr<EdgeRegistration> registration_ = std::make_unique<EdgeRegistration>();
};

PoseCameraFromObject InView() {
  return {ExpSo3(Vec3(0.4F, 0.7F, -0.2F)), Vec3(0.05F, -0.02F, 0.6F)};
}

/// The plane's front, seen a little from the side.
PoseCameraFromObject PlaneInView() {
  return PoseCameraFromObject(Mat3(ExpSo3(Vec3(2.7F, 0.2F, 0.0F))), Vec3(0.02F, -0.02F, 0.6F)) *
         OddPlace().Inverse();
}

/// What a frame may be off by: the object moved on while the velocity was not known yet.
class Perturbation {
 public:
  explicit Perturbation(unsigned seed) : random_(seed) {}
  [[nodiscard]] Vec6 operator()(float shift_m, float turn_rad) {
    Vec6 xi;
    xi.head<3>() = shift_m * Direction();
    xi.tail<3>() = turn_rad * Direction();
    return xi;
  }

 private:
  [[nodiscard]] Vec3 Direction() {
    std::normal_distribution<float> gaussian;
    const float x = gaussian(random_);
    const float y = gaussian(random_);
    return Vec3(x, y, gaussian(random_)).normalized();
  }
  std::mt19937 random_;
};

constexpr int kTrials = 40;

/// As good as nothing is known in directions of which the information says nothing.
Mat6 InverseOf(const Mat6& information) {
  Eigen::Matrix<double, 6, 6> h = information.cast<double>();
  h.diagonal().head<3>().array() += 1e-6 * h.diagonal().head<3>().mean();
  h.diagonal().tail<3>().array() += 1e-6 * h.diagonal().tail<3>().mean();
  return h.inverse().cast<float>();
}

/// Share of perturbed starts from which the observed directions come back to within `sigmas`
/// standard deviations that the noise leaves. Directions that are not observed have a row of zeros
/// in `observed`.
float ShareRecovered(Seen& seen, const Mat6& observed, float sigmas) {
  Perturbation perturbation(5);
  int recovered = 0;
  for (int i = 0; i < kTrials; ++i) {
    seen.Look(static_cast<unsigned>(i));
    const Vec6 xi = perturbation(0.008F, 5.0F * kDegree_rad);
    const auto result = seen.Align(seen.Off(xi));
    if (!result.solved) continue;
    const Vec6 error = observed * seen.ErrorOf(result.T_oc);
    const Mat6 covariance = observed * InverseOf(result.information.total) * observed.transpose();
    const Vec6 allowed = sigmas * covariance.diagonal().cwiseSqrt();
    recovered += (error.cwiseAbs().array() <= allowed.array() + 1e-6F).all() ? 1 : 0;
  }
  return static_cast<float>(recovered) / kTrials;
}

/// In these axes the first translation is along `axis`; likewise the rotation.
Mat6 AlongAxes(const Vec3& axis) {
  Mat3 rows;
  rows.row(0) = axis.transpose();
  rows.row(1) = axis.unitOrthogonal().transpose();
  rows.row(2) = axis.cross(axis.unitOrthogonal()).transpose();
  Mat6 result = Mat6::Zero();
  result.topLeftCorner<3, 3>() = rows;
  result.bottomRightCorner<3, 3>() = rows;
  return result;
}

TEST(Registration, BoxMovedAndTurned_IsPutBackInAllDirections) {
  Seen seen(OddBox(), InView());
  EXPECT_GE(ShareRecovered(seen, Mat6::Identity(), 6.0F), 0.95F);
}

TEST(Registration, StepsThatMayEndEarly_AreAQuarterFewerAndEndAsNearToTheTruth) {
  Seen seen(OddBox(), InView());
  Perturbation perturbation(7);
  struct {
    int steps = 0;
    float shift2_m2 = 0.0F;
    float turn2_rad2 = 0.0F;
  } all, few;
  const auto add = [&seen](auto& sums, const EdgeRegistration::Result& result) {
    ASSERT_TRUE(result.solved);
    const Vec6 error = seen.ErrorOf(result.T_oc);
    sums.steps += result.iterations;
    sums.shift2_m2 += error.head<3>().squaredNorm();
    sums.turn2_rad2 += error.tail<3>().squaredNorm();
  };
  for (int i = 0; i < kTrials; ++i) {
    seen.Look(static_cast<unsigned>(i));
    const PoseObjectFromCamera T_start = seen.Off(perturbation(0.008F, 5.0F * kDegree_rad));
    add(all, seen.Align(T_start, {12}));
    add(few, seen.Align(T_start, {12, true}));
  }
  EXPECT_LT(4 * few.steps, 3 * all.steps);
  EXPECT_LT(few.shift2_m2, 1.1F * all.shift2_m2);
  EXPECT_LT(few.turn2_rad2, 1.1F * all.turn2_rad2);
}

TEST(Registration, SphereMoved_IsPutBackAndItsTurnLeftAlone) {
  Seen seen(OddSphere(), InView());
  Mat6 position = Mat6::Zero();
  // The position of the sphere's centre, which a rotation about the middle of what is seen moves.
  seen.Look(0);
  const Vec3 arm_m = OddPlace().translation() - seen.T_oc() * seen.registration().center_c();
  position.topLeftCorner<3, 3>().setIdentity();
  position.topRightCorner<3, 3>() = -Skew(arm_m);
  EXPECT_GE(ShareRecovered(seen, position, 6.0F), 0.95F);

  seen.TrustPrediction();
  Perturbation perturbation(6);
  for (int i = 0; i < 10; ++i) {
    const Vec6 xi = perturbation(0.005F, 5.0F * kDegree_rad);
    const auto result = seen.Align(seen.Off(xi));
    ASSERT_TRUE(result.solved);
    const Vec3 turned = seen.ErrorOf(result.T_oc).tail<3>() - xi.tail<3>();
    EXPECT_LT(turned.norm(), 4.0F * kDegree_rad);
  }
}

TEST(Registration, PlaneMoved_IsPutBackAlongItsNormalAndDoesNotSlide) {
  Seen seen(OddPlane(), PlaneInView());
  const Mat6 along = AlongAxes(OddPlace().rotation() * Vec3::UnitZ());
  Mat6 observed = along;
  for (const int slide : {1, 2, 3}) observed.row(slide).setZero();
  EXPECT_GE(ShareRecovered(seen, observed, 6.0F), 0.95F);

  seen.TrustPrediction();
  Perturbation perturbation(6);
  for (int i = 0; i < 10; ++i) {
    const Vec6 xi = perturbation(0.005F, 5.0F * kDegree_rad);
    const auto result = seen.Align(seen.Off(xi));
    ASSERT_TRUE(result.solved);
    const Vec6 moved = along * (seen.ErrorOf(result.T_oc) - xi);
    EXPECT_LT(std::abs(moved(1)), 0.001F);
    EXPECT_LT(std::abs(moved(2)), 0.001F);
    EXPECT_LT(std::abs(moved(3)), 1.5F * kDegree_rad);
  }
}

TEST(Registration, BottleMoved_IsPutBackButForItsTurnAboutTheAxis) {
  Seen seen(Bottle(), InView());
  const Vec3 axis = OddPlace().rotation() * Vec3::UnitZ();
  seen.Look(0);
  const Vec3 center_m = seen.T_oc() * seen.registration().center_c();
  const Vec3 arm_m =
      OddPlace().translation() + axis * axis.dot(center_m - OddPlace().translation()) - center_m;
  // Of the point of the axis beside the middle of what is seen.
  Mat6 at_axis = Mat6::Identity();
  at_axis.topRightCorner<3, 3>() = -Skew(arm_m);
  Mat6 observed = AlongAxes(axis) * at_axis;
  observed.row(3).setZero();
  EXPECT_GE(ShareRecovered(seen, observed, 6.0F), 0.85F);

  seen.TrustPrediction();
  Perturbation perturbation(6);
  for (int i = 0; i < 10; ++i) {
    const Vec6 xi = perturbation(0.005F, 5.0F * kDegree_rad);
    const auto result = seen.Align(seen.Off(xi));
    ASSERT_TRUE(result.solved);
    EXPECT_LT(std::abs(axis.dot(seen.ErrorOf(result.T_oc).tail<3>() - xi.tail<3>())),
              4.0F * kDegree_rad);
  }
}

TEST(Registration, ErrorsOfABox_AreAsLargeAsTheInformationSays) {
  Seen seen(OddBox(), InView());
  double sum = 0.0;
  constexpr int kLooks = 100;
  for (int i = 0; i < kLooks; ++i) {
    seen.Look(static_cast<unsigned>(100 + i));
    const auto result = seen.Align(seen.T_oc());
    ASSERT_TRUE(result.solved);
    const Eigen::Matrix<double, 6, 1> error = seen.ErrorOf(result.T_oc).cast<double>();
    sum += error.dot(result.information.total.cast<double>() * error);
  }
  RecordProperty("nees", std::to_string(sum / kLooks));
  // Six degrees of freedom. The information counts the model's own variance and the robust weights
  // of the noise's tails too, so that the errors are smaller.
  EXPECT_LT(sum / kLooks, 6.0 * 1.3);
  EXPECT_GT(sum / kLooks, 6.0 / 6.0);
}

TEST(Registration, LessNoise_GivesSmallerErrors) {
  Seen seen(OddBox(), InView());
  std::array<float, 2> sum_m{};
  for (unsigned i = 0; i < 20; ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      seen.Look(i, k == 0 ? 1e-3F : 1e-4F);
      const auto result = seen.Align(seen.T_oc());
      ASSERT_TRUE(result.solved);
      sum_m[k] += seen.ErrorOf(result.T_oc).head<3>().norm();
    }
  }
  EXPECT_LT(sum_m[1], 0.3F * sum_m[0]);
}

/// H of a single observation is w J J^T: up to its scale, the derivative of the residual.
Vec6 JacobianOf(const Mat6& h) {
  int largest = 0;
  (void)h.diagonal().maxCoeff(&largest);
  return h.col(largest) / std::sqrt(h(largest, largest));
}
/// The angle's cosine between two directions, whatever their signs.
float Parallel(const Vec6& a, const Vec6& b) { return std::abs(a.dot(b)) / (a.norm() * b.norm()); }

/// Metres and radians on an equal footing for an object of this size.
constexpr float kLever_m = 0.05F;
Vec6 Balanced(Vec6 derivative) {
  derivative.tail<3>() /= kLever_m;
  return derivative;
}

/// d residual / d xi by central differences, xi applied about a centre as a registration does.
template <class Residual>
Vec6 Derivative(const PoseObjectFromCamera& T_oc, const Vec3& center_m, float step_m,
                Residual&& residual) {
  Vec6 derivative;
  for (int i = 0; i < 6; ++i) {
    const float step = i < 3 ? step_m : step_m / kLever_m;
    const auto at = [&](float sign) {
      Vec6 xi = Vec6::Zero();
      xi(i) = sign * step;
      const Mat3 turn = ExpSo3(Vec3(xi.tail<3>()));
      return residual(PoseObjectFromCamera(
          Mat3(turn * T_oc.rotation()),
          Vec3(turn * (T_oc.translation() - center_m) + center_m + xi.head<3>())));
    };
    derivative(i) = (at(1.0F) - at(-1.0F)) / (2.0F * step);
  }
  return derivative;
}

TEST(Registration, JacobianOfASurfaceSample_IsTheDerivativeOfTheTrueDistance) {
  for (const Shape& shape : {OddBox(), OddSphere(), Bottle()}) {
    Seen seen(shape, InView());
    std::mt19937 random(3);
    int checked = 0;
    int close = 0;
    for (int i = 0; i < 100; ++i) {
      const SurfacePoint point = shape.random_point(random);
      // Two points: the centre of rotation is their mean, so that each has a lever. The second is
      // far from any surface.
      SurfaceSample sample = Observe(point, {}, random);
      sample.position_m = seen.T_oc().Inverse() * point.position_m;
      sample.normal = seen.T_oc().rotation().transpose() * point.normal;
      SurfaceSample lonely = sample;
      constexpr float kAside_m = 0.16F;
      const Vec3 aside_m =
          kAside_m *
          Vec3(Uniform(random, -1.0F, 1.0F), 0.7F, Uniform(random, -1.0F, 1.0F)).normalized();
      lonely.position_m += seen.T_oc().rotation().transpose() * aside_m;
      FixedVector<SurfaceSample, 2> samples;
      (void)samples.push_back(sample);
      (void)samples.push_back(lonely);
      const EdgeRegistration::Edges no_edges;
      seen.registration().SetObservations(samples, no_edges);
      const auto result =
          seen.registration().Align(seen.model(), seen.edges(), seen.config(), seen.T_oc(),
                                    seen.T_oc(), {0.0005F, 0.0005F}, {1});
      if (result.unmatched != 1) continue;
      const Vec6 truth =
          Derivative(seen.T_oc(), result.center_m, 1e-3F, [&](const PoseObjectFromCamera& T_oc) {
            return shape.distance_m(T_oc * sample.position_m);
          });
      ++checked;
      // The shape's own derivative, not the model's: the GP's gradient is off by a few degrees, and
      // by more near a crease.
      const float parallel =
          Parallel(Balanced(JacobianOf(result.information.total)), Balanced(truth));
      if (parallel > 0.95F) ++close;
      EXPECT_GT(parallel, 0.85F) << point.position_m.transpose();
    }
    EXPECT_GT(checked, 50);
    EXPECT_GT(10 * close, 9 * checked);
  }
}

TEST(Registration, JacobianOfAnEdge_IsTheDerivativeOfTheRaysDistanceFromIt) {
  Seen seen(OddBox(), InView());
  std::mt19937 random(4);
  std::normal_distribution<float> gaussian;
  const auto direction = [&] {
    const float x = gaussian(random);
    const float y = gaussian(random);
    return Vec3(x, y, gaussian(random)).normalized();
  };
  int checked = 0;
  for (int i = 0; i < 100; ++i) {
    EdgePoint model_edge;
    model_edge.position_m = 0.05F * direction();
    model_edge.direction = direction();
    model_edge.normal = model_edge.direction.unitOrthogonal();
    model_edge.ray = -model_edge.normal;
    model_edge.outward = model_edge.ray.cross(model_edge.direction);
    model_edge.variance_m2 = 1e-7F;
    seen.edges().Start();
    seen.edges().SetRounding({0.0F, 1e-12F});  // sharp
    Counters counters;
    seen.edges().Insert(model_edge, 0.004F, 0, counters);
    // Seen from the camera at the origin of its frame.
    const PoseCameraFromObject T_co = seen.T_oc().Inverse();
    EdgePoint observed;
    observed.position_m = T_co * model_edge.position_m;
    observed.ray = observed.position_m.normalized();
    observed.direction = T_co.rotation() * model_edge.direction;
    observed.normal = T_co.rotation() * model_edge.normal;
    observed.outward = observed.ray.cross(observed.direction).normalized();
    observed.variance_m2 = 1e-7F;
    const Vec3 e_m = model_edge.position_m;
    const Vec3 d = model_edge.direction;
    if (std::abs(d.dot(seen.T_oc().rotation() * observed.ray)) > 0.9F) continue;
    EdgeRegistration::Edges edges;
    (void)edges.push_back(observed);
    const FixedVector<SurfaceSample, 1> no_samples;
    seen.registration().SetObservations(no_samples, edges);
    const auto result =
        seen.registration().Align(seen.model(), seen.edges(), seen.config(), seen.T_oc(),
                                  seen.T_oc(), {0.0005F, 0.0005F}, {1});
    ASSERT_EQ(result.edge_inliers, 1);
    const Vec6 truth =
        Derivative(seen.T_oc(), result.center_m, 1e-3F, [&](const PoseObjectFromCamera& T_oc) {
          // Distance of two lines: the viewing ray and the edge.
          const Vec3 ray = T_oc.rotation() * observed.ray;
          return ray.cross(d).normalized().dot(T_oc * observed.position_m - e_m);
        });
    ++checked;
    EXPECT_GT(Parallel(JacobianOf(result.information.total), truth), 0.999F);
  }
  EXPECT_GT(checked, 50);
}

/// The same box and camera, described in an object frame whose axes are permuted: the octree's
/// cells are the same ones.
TEST(Registration, OtherObjectAxes_TurnTheInformation) {
  Mat3 permuted;
  permuted << 0.0F, 0.0F, 1.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F;
  Seen seen(OddBox(), InView());
  const Transform<Object, Object> turn(permuted, Vec3(Vec3::Zero()));
  Seen otherwise(Moved(OddBox(), turn), InView() * turn.Inverse());
  seen.Look(1);
  otherwise.Look(1);
  const auto a = seen.Align(seen.T_oc());
  const auto b = otherwise.Align(otherwise.T_oc());
  ASSERT_TRUE(a.solved && b.solved);
  Mat6 both = Mat6::Zero();
  both.topLeftCorner<3, 3>() = permuted;
  both.bottomRightCorner<3, 3>() = permuted;
  const Mat6 expected = both * a.information.total * both.transpose();
  EXPECT_LT((b.information.total - expected).norm(), 0.02F * expected.norm());
  const Mat6 across = both * a.information.across * both.transpose();
  EXPECT_LT((b.information.across - across).norm(), 0.02F * across.norm());
  EXPECT_LT((permuted * a.center_m - b.center_m).norm(), 1e-4F);
}

TEST(Registration, NormalsAsNoisyAsTheyState_ShowNoErrorOfTheGradients) {
  Seen seen(OddBox(), InView());
  seen.Look(1);
  const auto result = seen.Align(seen.T_oc());
  ASSERT_TRUE(result.solved);
  EXPECT_LT(std::sqrt(result.information.gradient_variance_rad2), 0.01F);
}

TEST(Registration, NormalsOffTheModels_ShowTheErrorOfItsGradients) {
  Seen seen(OddBox(), InView());
  for (const float tilt_rad : {0.05F, 0.1F, 0.2F}) {
    seen.Look(1, kNoise_m, tilt_rad);
    const auto result = seen.Align(seen.T_oc());
    ASSERT_TRUE(result.solved);
    // A quarter of what is seen: the rest is the frame's own.
    EXPECT_NEAR(std::sqrt(result.information.gradient_variance_rad2), 0.5F * tilt_rad,
                0.1F * tilt_rad);
  }
}

TEST(Registration, TruePose_ScoresHighest) {
  Seen seen(OddBox(), InView());
  seen.Look(1);
  const float at_truth = seen.Score(seen.T_oc());
  EXPECT_GT(at_truth, 0.95F);
  EXPECT_LE(at_truth, 1.0F);
  Perturbation perturbation(8);
  for (int i = 0; i < 20; ++i)
    EXPECT_LT(seen.Score(seen.Off(perturbation(0.006F, 0.1F))), at_truth - 0.05F);
  EXPECT_EQ(seen.Score({seen.T_oc().rotation(), Vec3(seen.T_oc().translation() + Vec3::Ones())}),
            0.0F);
}

TEST(Registration, NothingToMatch_IsNotSolvedAndKeepsTheStart) {
  Seen seen(OddBox(), InView());
  seen.Look(1);
  const PoseObjectFromCamera far(seen.T_oc().rotation(),
                                 Vec3(seen.T_oc().translation() + Vec3::Ones()));
  const auto result = seen.Align(far);
  EXPECT_FALSE(result.solved);
  EXPECT_EQ(result.T_oc.translation(), far.translation());
  EXPECT_EQ(result.inliers, 0);
  const FixedVector<SurfaceSample, 1> nothing;
  const EdgeRegistration::Edges no_edges;
  seen.registration().SetObservations(nothing, no_edges);
  EXPECT_FALSE(seen.Align(seen.T_oc()).solved);
  EXPECT_EQ(seen.Score(seen.T_oc()), 0.0F);
}

TEST(Registration, ScoreOfTheAlignedPose_IsThatOfASearchOfAllItsPoints) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    Seen seen(OddBox(), InView());
    seen.Look(seed);
    seen.config().score_points = Samples::kCapacity;
    Vec6 xi;
    xi << 0.003F, -0.002F, 0.001F, 0.01F, 0.0F, -0.02F;
    const auto aligned = seen.Align(seen.Off(xi));
    ASSERT_TRUE(aligned.solved);
    const float searched = seen.Score(aligned.T_oc);
    const float known =
        seen.registration().ScoreOfAligned(seen.model(), seen.config(), aligned.T_oc);
    EXPECT_GT(known, 0.5F);
    EXPECT_NEAR(known, searched, 0.01F) << seed;
  }
}

TEST(Registration, MoreSamplesThanFit_AreThinnedEvenly) {
  Seen seen(OddBox(), InView());
  FixedVector<SurfaceSample, 4 * Samples::kCapacity> many;
  for (int i = 0; i < many.kCapacity; ++i) {
    SurfaceSample sample;
    sample.position_m = Vec3(static_cast<float>(i), 0.0F, 0.0F);
    (void)many.push_back(sample);
  }
  const EdgeRegistration::Edges no_edges;
  seen.registration().SetObservations(many, no_edges);
  EXPECT_EQ(seen.Align(seen.T_oc()).points, Samples::kCapacity);
  EXPECT_NEAR(seen.registration().center_c().x(), 0.5F * static_cast<float>(many.kCapacity), 2.0F);
}

TEST(Registration, StrongPrediction_HoldsWhatTheSurfaceDoesNot) {
  Seen seen(OddPlane(), PlaneInView());
  seen.Look(2);
  seen.config().temporal_std_m = 0.005F;
  const Vec3 slide = OddPlace().rotation() * Vec3::UnitX();
  Vec6 xi = Vec6::Zero();
  xi.head<3>() = 0.01F * slide;
  // The start is off along the plane, the prediction is right.
  const auto result = seen.registration().Align(seen.model(), seen.edges(), seen.config(),
                                                seen.Off(xi), seen.T_oc(), {0.01F, 0.003F}, {20});
  ASSERT_TRUE(result.solved);
  EXPECT_LT(seen.ErrorOf(result.T_oc).head<3>().norm(), 0.001F);
}

}  // namespace
}  // namespace disflow::testing
