// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/field_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

#include "disflow/types.h"

namespace disflow {
namespace {

constexpr int kClusters = 640;

TEST(FieldFit, WhatFits_KeepsTheCellsThatAreSet) {
  // A bottle's view, and one of nothing.
  EXPECT_EQ(CoarsenessFor(0.01F, kClusters, {}), 1.0F);
  EXPECT_EQ(CoarsenessFor(0.0F, kClusters, {}), 1.0F);
  EXPECT_EQ(CoarsenessFor(std::numeric_limits<float>::quiet_NaN(), kClusters, {}), 1.0F);
}

TEST(FieldFit, CellsGrowWithTheSizeOfALargeObject) {
  const float once = CoarsenessFor(0.06F, kClusters, {});
  EXPECT_GT(once, 1.0F);
  // As large again in all directions.
  EXPECT_NEAR(CoarsenessFor(4.0F * 0.06F, kClusters, {}), 2.0F * once, 1e-5F);
  EXPECT_NEAR(CoarsenessFor(0.06F, kClusters / 4, {}), 2.0F * once, 1e-5F);
}

TEST(FieldFit, SamplesAreNeverFartherApartThanTheyAreMatched) {
  for (const float seen_m2 : {0.1F, 1.0F, 100.0F, std::numeric_limits<float>::infinity()}) {
    const Config config;
    const FieldConfig field = Coarser(config.field, CoarsenessFor(seen_m2, kClusters, config));
    EXPECT_LE(field.merge_radius_m, config.registration.match_radius_m * 1.0001F) << seen_m2;
    EXPECT_GT(field.cell_size_m, config.field.cell_size_m);
  }
}

TEST(FieldFit, SwitchedOff_CellsAreThoseThatAreSet) {
  Config config;
  config.field.fit_to_object = 0;
  EXPECT_EQ(CoarsenessFor(1.0F, kClusters, config), 1.0F);
}

TEST(FieldFit, CellsOfACoarserField_AreAsFullAsThoseOfOneThatIsNot) {
  const FieldConfig set;
  const FieldConfig coarser = Coarser(set, 1.7F);
  EXPECT_FLOAT_EQ(coarser.cell_size_m, 1.7F * set.cell_size_m);
  EXPECT_FLOAT_EQ(coarser.cell_size_m / coarser.merge_radius_m,
                  set.cell_size_m / set.merge_radius_m);
  EXPECT_FLOAT_EQ(coarser.overlap_m / coarser.cell_size_m, set.overlap_m / set.cell_size_m);
  EXPECT_EQ(coarser.length_scale_m, set.length_scale_m);
}

/// Cells of the given size that a sphere about the origin passes through.
int CellsOfSphere(float radius_m, float cell_m) {
  constexpr int kPoints = 400000;
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::set<std::tuple<int, int, int>> cells;
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / kPoints;
    const double r = std::sqrt(1.0 - z * z);
    const Vec3 x_m =
        radius_m * Vec3(static_cast<float>(r * std::cos(golden * i)),
                        static_cast<float>(r * std::sin(golden * i)), static_cast<float>(z));
    const Vec3 cell = (x_m / cell_m).array().floor();
    cells.emplace(static_cast<int>(cell.x()), static_cast<int>(cell.y()),
                  static_cast<int>(cell.z()));
  }
  return static_cast<int>(cells.size());
}

TEST(FieldFit, SphereOfWhichAViewShowsADisk_PassesThroughAboutAsManyCellsAsThereAreLocalGps) {
  constexpr float kRadius_m = 0.2F;
  const float disk_m2 = std::numbers::pi_v<float> * kRadius_m * kRadius_m;
  const FieldConfig field = Coarser({}, CoarsenessFor(disk_m2, kClusters, {}));
  const int cells = CellsOfSphere(kRadius_m, field.cell_size_m);
  EXPECT_GT(cells, kClusters * 9 / 10);
  EXPECT_LT(cells, kClusters * 11 / 10);
}

}  // namespace
}  // namespace disflow
