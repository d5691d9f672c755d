// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/nearest_columns.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace disflow {
namespace {

constexpr int kWidth_px = 200;
constexpr int kHeight_px = 20;

class NearestColumnsTest : public ::testing::Test {
 protected:
  NearestColumnsTest() : depth_m_(static_cast<std::size_t>(kWidth_px * kHeight_px)) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> any_m(-0.2F, 1.0F);
    for (float& depth_m : depth_m_) depth_m = any_m(random);
    view_.data = depth_m_.data();
    view_.width_px = kWidth_px;
    view_.height_px = kHeight_px;
    view_.stride_bytes = kWidth_px * static_cast<std::ptrdiff_t>(sizeof(float));
    view_.format = DepthFormat::kFloat32;
  }

  /// Pixel by pixel.
  [[nodiscard]] static NearestDepth Expected(const DepthReader& depth, const PixelBox& box) {
    NearestDepth nearest;
    for (int v = box.v_min; v < box.v_max; ++v) {
      for (int u = box.u_min; u < box.u_max; ++u) {
        if (depth.At(u, v) > 0.0F) nearest.Add({depth.At(u, v), 1});
      }
    }
    return nearest;
  }

  std::vector<float> depth_m_;
  DepthView view_;
};

TEST_F(NearestColumnsTest, AnyColumns_HaveTheNearestOfTheirPixelsAndTheirNumber) {
  const DepthReader depth(view_, 0.1F, 0.9F);
  for (const PixelBox& box : {PixelBox{0, 0, 128, 20}, {72, 3, 200, 4}, {10, 5, 11, 9}}) {
    NearestColumns columns;
    columns.Scan(depth, box);
    for (const auto& [begin, end] :
         {std::pair{0, box.width()}, {0, 1}, {box.width() / 2, box.width()}}) {
      const NearestDepth found = columns.Within(begin, end);
      const NearestDepth expected =
          Expected(depth, {box.u_min + begin, box.v_min, box.u_min + end, box.v_max});
      EXPECT_EQ(found.depth_m, expected.depth_m);
      EXPECT_EQ(found.valid, expected.valid);
    }
  }
}

TEST_F(NearestColumnsTest, WithoutAnyDepth_HasNone) {
  const DepthReader depth(view_, 2.0F, 3.0F);
  NearestColumns columns;
  columns.Scan(depth, {0, 0, 100, kHeight_px});
  EXPECT_EQ(columns.Within(0, 100).valid, 0);
  EXPECT_EQ(columns.Within(0, 100).depth_m, NearestDepth::kNone_m);
}

}  // namespace
}  // namespace disflow
