// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/geometry/pinhole_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace disflow {
namespace {

constexpr PinholeCamera kCamera{614.7F, 615.2F, 320.5F, 181.25F};

TEST(PinholeCamera, BackProjectedPixel_ProjectsToItself) {
  for (float v_px = 0.0F; v_px < 360.0F; v_px += 37.0F) {
    for (float u_px = 0.0F; u_px < 640.0F; u_px += 53.0F) {
      for (const float depth_m : {0.1F, 0.7F, 4.0F}) {
        const Vec3 x_c = kCamera.BackProject(u_px, v_px, depth_m);
        EXPECT_FLOAT_EQ(x_c.z(), depth_m);
        EXPECT_LT((kCamera.Project(x_c) - Vec2(u_px, v_px)).norm(), 1e-3F);
      }
    }
  }
}

TEST(PinholeCamera, PrincipalPoint_LooksStraightAhead) {
  EXPECT_EQ(kCamera.Ray(kCamera.cx_px, kCamera.cy_px), Vec3(0.0F, 0.0F, 1.0F));
}

TEST(PinholeCamera, Axes_AreRightDownForward) {
  const Vec2 right = kCamera.Project({0.1F, 0.0F, 1.0F});
  const Vec2 down = kCamera.Project({0.0F, 0.1F, 1.0F});
  EXPECT_FLOAT_EQ(right.x(), kCamera.cx_px + 0.1F * kCamera.fx_px);
  EXPECT_FLOAT_EQ(right.y(), kCamera.cy_px);
  EXPECT_FLOAT_EQ(down.x(), kCamera.cx_px);
  EXPECT_FLOAT_EQ(down.y(), kCamera.cy_px + 0.1F * kCamera.fy_px);
}

TEST(PixelAt, IsTheNearestPixel_HalvesAwayFromZero) {
  for (int i = -4000; i <= 4000; ++i) {
    // Halves, and the numbers next to them.
    const float half = 0.5F * static_cast<float>(i);
    for (const float px : {half, std::nextafter(half, -1e9F), std::nextafter(half, 1e9F)}) {
      const PixelAt at(Vec2(px, -px));
      ASSERT_EQ(at.u, std::lround(px)) << px;
      ASSERT_EQ(at.v, std::lround(-px)) << px;
    }
  }
}

TEST(PixelAt, OfWhatNoImageHolds_IsOutsideOfAllImages) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float px : {kInfinity, -kInfinity, 1e20F, -1e20F, std::nanf("")}) {
    const PixelAt at(Vec2(px, 0.0F));
    EXPECT_TRUE(at.u < 0 || at.u > 32767) << px;
  }
}

TEST(PinholeCamera, FartherPoint_IsNearerToThePrincipalPoint) {
  const Vec2 center(kCamera.cx_px, kCamera.cy_px);
  const Vec2 near = kCamera.Project({0.1F, 0.1F, 0.5F}) - center;
  const Vec2 far = kCamera.Project({0.1F, 0.1F, 1.0F}) - center;
  EXPECT_LT((near - 2.0F * far).norm(), 1e-3F);
}

TEST(PinholeCamera, EveryBadIntrinsic_IsInvalid) {
  EXPECT_TRUE(kCamera.IsValid());
  EXPECT_FALSE(PinholeCamera{}.IsValid());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (float PinholeCamera::*field : {&PinholeCamera::fx_px, &PinholeCamera::fy_px}) {
    for (const float bad : {0.0F, -1.0F, nan, infinity}) {
      PinholeCamera camera = kCamera;
      camera.*field = bad;
      EXPECT_FALSE(camera.IsValid()) << bad;
    }
  }
  for (float PinholeCamera::*field : {&PinholeCamera::cx_px, &PinholeCamera::cy_px}) {
    for (const float bad : {nan, infinity, -infinity}) {
      PinholeCamera camera = kCamera;
      camera.*field = bad;
      EXPECT_FALSE(camera.IsValid()) << bad;
    }
  }
}

TEST(PinholeCamera, PrincipalPointOutsideOfTheImage_IsAllowed) {
  PinholeCamera cropped = kCamera;
  cropped.cx_px = -200.0F;
  EXPECT_TRUE(cropped.IsValid());
}

TEST(PinholeCamera, FocalLengthThatNoLensHas_IsInvalid) {
  for (float PinholeCamera::*field : {&PinholeCamera::fx_px, &PinholeCamera::fy_px}) {
    for (const float bad : {1e-38F, 1e-30F, 0.5F, 1e7F, 1e38F}) {
      PinholeCamera camera = kCamera;
      camera.*field = bad;
      EXPECT_FALSE(camera.IsValid()) << bad;
    }
    for (const float good : {1.0F, 30.0F, 1e4F}) {
      PinholeCamera camera = kCamera;
      camera.*field = good;
      EXPECT_TRUE(camera.IsValid()) << good;
    }
  }
}

TEST(PinholeCamera, ImageThatReachesBehindTheCamera_CannotBeTaken) {
  EXPECT_TRUE(kCamera.CanImage(640, 360));
  // A fisheye's field of view, 174 degrees: the widest that is taken.
  EXPECT_TRUE((PinholeCamera{16.0F, 16.0F, 320.0F, 180.0F}.CanImage(640, 360)));
  EXPECT_FALSE((PinholeCamera{15.9F, 16.0F, 320.0F, 180.0F}.CanImage(640, 360)));
  EXPECT_FALSE((PinholeCamera{600.0F, 8.9F, 320.0F, 180.0F}.CanImage(640, 360)));
  PinholeCamera far_off = kCamera;
  far_off.cx_px = -20.0F * kCamera.fx_px;
  EXPECT_FALSE(far_off.CanImage(640, 360));
  far_off.cx_px = 1e30F;
  EXPECT_FALSE(far_off.CanImage(640, 360));
  far_off.cx_px = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(far_off.CanImage(640, 360));
}

}  // namespace
}  // namespace disflow
