// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/model_agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "disflow/field/known_surface.h"
#include "disflow/flow/model_silhouette.h"
#include "model_builder.h"

namespace disflow::testing {
namespace {

constexpr int kWidth_px = 160;
constexpr int kHeight_px = 120;
constexpr PinholeCamera kCamera{150.0F, 150.0F, 80.0F, 60.0F};
constexpr float kRadius_m = 0.05F;
constexpr float kDistance_m = 0.5F;

/// A ball before a wall, and a model of it.
class BallInView : public ::testing::Test {
 protected:
  BallInView()
      : model_(MakeModel(Sphere(kRadius_m, Vec3::Zero()))),
        depth_m_(static_cast<std::size_t>(kWidth_px * kHeight_px)) {
    DrawBall(Vec3(0.0F, 0.0F, kDistance_m));
  }
  void DrawBall(const Vec3& center_c) {
    for (int v = 0; v < kHeight_px; ++v) {
      for (int u = 0; u < kWidth_px; ++u) {
        const Vec3 ray = kCamera.Ray(static_cast<float>(u), static_cast<float>(v));
        const float along = ray.dot(center_c);
        const float root =
            along * along - ray.squaredNorm() * (center_c.squaredNorm() - kRadius_m * kRadius_m);
        Pixel(u, v) = root > 0.0F ? (along - std::sqrt(root)) / ray.squaredNorm() : 1.5F;
      }
    }
  }
  /// Something nearer on the left of a column.
  void DrawScreen(int u_end, float depth_m) {
    for (int v = 0; v < kHeight_px; ++v) {
      for (int u = 0; u < u_end; ++u) Pixel(u, v) = depth_m;
    }
  }
  [[nodiscard]] ModelAgreement At(const Vec3& center_c) const {
    const DepthView view{depth_m_.data(),       kWidth_px, kHeight_px, 4 * kWidth_px,
                         DepthFormat::kFloat32, 0.001F};
    return CompareWithImage(*model_, PoseCameraFromObject(Mat3::Identity(), center_c).Inverse(),
                            kCamera, DepthReader(view, 0.1F, 10.0F));
  }

  std::unique_ptr<EdgeField> model_;

 private:
  [[nodiscard]] float& Pixel(int u, int v) {
    return depth_m_[static_cast<std::size_t>(v * kWidth_px + u)];
  }
  std::vector<float> depth_m_;
};

TEST_F(BallInView, TruePose_IsNotContradicted) {
  const ModelAgreement agreement = At(Vec3(0.0F, 0.0F, kDistance_m));
  EXPECT_GT(agreement.seen, 3);
  EXPECT_EQ(agreement.conflict(), 0.0F);
  EXPECT_EQ(agreement.visible(), 1.0F);
}

TEST_F(BallInView, PoseInFrontOfTheBall_IsLookedThrough) {
  const ModelAgreement agreement = At(Vec3(0.0F, 0.0F, kDistance_m - 0.04F));
  EXPECT_GT(agreement.conflict(), 0.9F);
}

TEST_F(BallInView, PoseBesideTheBall_IsContradictedInPart) {
  const ModelAgreement agreement = At(Vec3(0.05F, 0.0F, kDistance_m));
  EXPECT_GT(agreement.conflict(), 0.3F);
  EXPECT_LT(agreement.conflict(), 1.0F);
}

TEST_F(BallInView, PoseOffByAPixel_ContradictsNothingAtTheOutline) {
  for (int i = 0; i < 16; ++i) {
    const float angle = 0.3926991F * static_cast<float>(i);
    const Vec3 shift_m = 0.0045F * Vec3(std::cos(angle), std::sin(angle), 0.0F);
    EXPECT_EQ(At(Vec3(0.0F, 0.0F, kDistance_m) + shift_m).contradicted, 0) << shift_m.transpose();
  }
}

TEST(BesideSurface, ReachesAsFarAsAsked) {
  // Surface on the left of a column, nothing but a far wall on its right.
  constexpr int kEnd_px = 80;
  constexpr float kNear_m = 0.5F;
  std::vector<float> depth_m(static_cast<std::size_t>(kWidth_px * kHeight_px), 1.5F);
  for (std::size_t v = 0; v < kHeight_px; ++v)
    std::fill_n(depth_m.begin() + static_cast<std::ptrdiff_t>(v * kWidth_px), kEnd_px, kNear_m);
  const DepthReader depth(
      {depth_m.data(), kWidth_px, kHeight_px, 4 * kWidth_px, DepthFormat::kFloat32, 0.001F}, 0.1F,
      10.0F);
  // That of an object's model, and of a room's.
  for (const float reach_m : {0.004F, 0.06F}) {
    const float reach_px = reach_m * kCamera.fx_px / kNear_m;
    const auto is_beside = [&](float beyond_px) {
      const Vec2 px(static_cast<float>(kEnd_px - 1) + beyond_px, 60.0F);
      return IsBesideSurface(depth, kCamera, px, kNear_m, reach_m, 0.01F);
    };
    EXPECT_TRUE(is_beside(reach_px)) << reach_m;
    EXPECT_FALSE(is_beside(reach_px + 1.0F)) << reach_m;
  }
}

TEST_F(BallInView, PoseBehindTheBall_IsHidden) {
  const ModelAgreement agreement = At(Vec3(0.0F, 0.0F, kDistance_m + 0.1F));
  EXPECT_EQ(agreement.seen, 0);
  EXPECT_GT(agreement.hidden, agreement.contradicted);
}

TEST_F(BallInView, HiddenHalf_CountsNeitherWay) {
  DrawScreen(kWidth_px / 2, 0.3F);
  const ModelAgreement agreement = At(Vec3(0.0F, 0.0F, kDistance_m));
  EXPECT_EQ(agreement.conflict(), 0.0F);
  EXPECT_NEAR(agreement.visible(), 0.5F, 0.2F);
}

TEST_F(BallInView, PartOutsideOfTheImage_IsNotVisible) {
  const Vec3 at_border(0.5F * kDistance_m * kWidth_px / kCamera.fx_px, 0.0F, kDistance_m);
  DrawBall(at_border);
  const ModelAgreement agreement = At(at_border);
  EXPECT_GT(agreement.outside, 0);
  EXPECT_EQ(agreement.conflict(), 0.0F);
  EXPECT_NEAR(agreement.visible(), 0.5F, 0.25F);
}

TEST_F(BallInView, BehindTheCamera_NothingIsInView) {
  const ModelAgreement agreement = At(Vec3(0.0F, 0.0F, -kDistance_m));
  EXPECT_EQ(agreement.facing(), 0);
  EXPECT_EQ(agreement.conflict(), 0.0F);
  EXPECT_EQ(agreement.visible(), 0.0F);
}

/// What an image in which there is nothing but a wall says of a shape of which there is a model.
struct LookedThrough {
  float conflict = 0.0F;
  float resolved_conflict = 0.0F;
};
/// @param turn_rad Of the shape in the image.
LookedThrough LookThrough(const Shape& shape, float distance_m, float turn_rad = 0.0F) {
  const auto model = MakeModel(shape);
  const std::vector<float> depth_m(static_cast<std::size_t>(kWidth_px * kHeight_px), 1.5F);
  const DepthReader depth(
      {depth_m.data(), kWidth_px, kHeight_px, 4 * kWidth_px, DepthFormat::kFloat32, 0.001F}, 0.1F,
      10.0F);
  const PoseCameraFromObject T_co(ExpSo3(Vec3(0.0F, 0.0F, turn_rad)), Vec3(0.0F, 0.0F, distance_m));
  const PoseObjectFromCamera T_oc = T_co.Inverse();
  const ModelAgreement agreement = CompareWithImage(*model, T_oc, kCamera, depth);
  EXPECT_GT(agreement.contradicted, 3);
  return {agreement.conflict(), ResolvedConflict(*model, T_oc, kCamera, depth, agreement)};
}

TEST(ResolvedConflict, SheetSeenFromItsEdge_IsNotResolved) {
  // 5 mm are 1.5 pixels; in any direction of the image.
  const Shape sheet = Box(Vec3(0.04F, 0.0025F, 0.03F), 0.0F);
  for (const float turn_rad : {0.0F, 0.4F, 0.8F, 1.57F}) {
    const LookedThrough image = LookThrough(sheet, kDistance_m, turn_rad);
    EXPECT_EQ(image.conflict, 1.0F) << turn_rad;
    EXPECT_EQ(image.resolved_conflict, 0.0F) << turn_rad;
  }
}

TEST(ResolvedConflict, WideSurfaceThatIsNotThere_Contradicts) {
  const Shape sheet = Box(Vec3(0.04F, 0.03F, 0.0025F), 0.0F);
  for (const float turn_rad : {0.0F, 0.8F}) {
    const LookedThrough image = LookThrough(sheet, kDistance_m, turn_rad);
    EXPECT_EQ(image.conflict, 1.0F) << turn_rad;
    EXPECT_GT(image.resolved_conflict, 0.9F) << turn_rad;
  }
}

TEST(ResolvedConflict, NearTheCamera_ItsPointsFarApart_SurfaceHasNoHoles) {
  const Shape sheet = Box(Vec3(0.04F, 0.03F, 0.0025F), 0.0F);
  for (const float distance_m : {0.12F, 0.16F, 0.25F}) {
    EXPECT_GT(LookThrough(sheet, distance_m).resolved_conflict, 0.9F) << distance_m;
  }
}

TEST(ResolvedConflict, SheetNearTheCamera_IsResolved) {
  // 10 mm are 19 pixels.
  const Shape sheet = Box(Vec3(0.02F, 0.005F, 0.01F), 0.0F);
  EXPECT_EQ(LookThrough(sheet, 0.08F).resolved_conflict, 1.0F);
}

TEST_F(BallInView, KnownSurface_IsNearItsPointsOnly) {
  constexpr float kNear_m = 0.012F;
  std::mt19937 random(3);
  const Shape ball = Sphere(kRadius_m, Vec3::Zero());
  for (int i = 0; i < 300; ++i) {
    const SurfacePoint point = ball.random_point(random);
    EXPECT_TRUE(IsNearSurface(*model_, point.position_m, kNear_m));
    EXPECT_TRUE(IsNearSurface(*model_, Vec3(point.position_m + 0.006F * point.normal), kNear_m));
    EXPECT_FALSE(IsNearSurface(*model_, Vec3(point.position_m + 0.05F * point.normal), kNear_m));
  }
  EXPECT_FALSE(IsNearSurface(*model_, Vec3(Vec3::Zero()), kNear_m));
}

}  // namespace
}  // namespace disflow::testing
